#include <cerrno>
#include <contact/core/whole_file.hpp>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <unistd.h>

namespace nonsmooth::contact {
namespace {

	/// As nonsmooth/whole_files.py names it.
	std::string beside(const std::filesystem::path& path)
	{
		std::random_device random;
		char               token[17];
		std::snprintf(token, sizeof token, "%08x%08x", random(), random());
		return (path.parent_path() / (".part-" + std::string(token) + "-" + path.filename().string())).string();
	}

	/// Whether all of it went to the disk.
	bool put(int file, const char* bytes, std::size_t count)
	{
		while (count > 0) {
			const ssize_t done = ::write(file, bytes, count);
			if (done < 0 && errno == EINTR) continue;
			if (done <= 0) return false;
			bytes += done;
			count -= static_cast<std::size_t>(done);
		}
		return ::fsync(file) == 0;
	}

} // namespace

std::string writeWhole(const std::string& path, const char* bytes, std::size_t count)
{
	const std::string part = beside(path);
	const int         file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
	if (file < 0) return std::strerror(errno);
	bool      written = put(file, bytes, count);
	int       why     = errno;
	const int closed  = ::close(file);
	if (written && closed != 0) {
		written = false;
		why     = errno;
	}
	if (written && std::rename(part.c_str(), path.c_str()) == 0) return "";
	if (written) why = errno;
	::unlink(part.c_str());
	return std::strerror(why);
}

} // namespace nonsmooth::contact
