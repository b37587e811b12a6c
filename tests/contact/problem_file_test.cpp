// A contact problem survives the file, bit for bit; files that are not one are refused with their name.
#include "problems.hpp"
#include <contact/plane/problem_file.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

class ProblemFile : public ::testing::Test {
protected:
	// one a test: ctest runs several at a time
	std::filesystem::path folder = std::filesystem::path(::testing::TempDir())
	        / (std::string("nonsmooth_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_"
	           + std::to_string(getpid()));
	std::string path = (folder / "step.h5").string();

	void SetUp() override { std::filesystem::create_directories(folder); }
	void TearDown() override { std::filesystem::remove_all(folder); }

	std::vector<std::string> names() const
	{
		std::vector<std::string> found;
		for (const auto& entry : std::filesystem::directory_iterator(folder))
			found.push_back(entry.path().filename().string());
		return found;
	}

	/// What reading the file complains about.
	std::string complaint() const
	{
		try {
			read(path);
		} catch (const std::runtime_error& error) {
			return error.what();
		}
		return "";
	}
};

TEST_F(ProblemFile, KeepsEveryBit)
{
	RecordedProblem out { lattice(12, 5).problem, {}, step };
	out.warmStart = out.problem.impulses;
	SolverSettings s;
	s.tolerance = 1e-8;
	solve(out.problem, s);
	write(path, out);
	const RecordedProblem in = read(path);
	EXPECT_EQ(in.timeStep, step);
	EXPECT_TRUE(sameBits(in.warmStart, out.warmStart));
	EXPECT_TRUE(sameBits(in.problem.impulses, out.problem.impulses));
	EXPECT_TRUE(sameBits(in.problem.velocities, out.problem.velocities));
	EXPECT_TRUE(sameBits(in.problem.freeVelocity, out.problem.freeVelocity));
	EXPECT_TRUE(sameBits(in.problem.inverseMass, out.problem.inverseMass));
	EXPECT_TRUE(sameBits(in.problem.positions, out.problem.positions));
	ASSERT_EQ(in.problem.contactCount(), out.problem.contactCount());

	// and so a solve of what was read gives the same bits
	Problem again  = in.problem;
	again.impulses = in.warmStart;
	solve(again, s);
	EXPECT_TRUE(sameBits(again.impulses, out.problem.impulses));
	EXPECT_EQ(names(), std::vector<std::string> { "step.h5" });
}

TEST_F(ProblemFile, KeepsEveryNumberOfAContactInItsPlace)
{
	Contact c;
	c.i = 1, c.j = 2;
	double number                    = 0.5;
	double Contact::*const numbers[] = { &Contact::nx,       &Contact::ny,       &Contact::leverNi,
		                             &Contact::leverTi,  &Contact::leverNj,  &Contact::leverTj,
		                             &Contact::biasN,    &Contact::biasT,    &Contact::biasR,
		                             &Contact::adhesion, &Contact::friction, &Contact::rollingArm,
		                             &Contact::length,   &Contact::play };
	for (double Contact::*const x : numbers)
		c.*x = number += 1;
	RecordedProblem out { lattice(3, 1).problem, {}, step };
	out.problem.contacts = { c };
	out.problem.impulses = { { 1, 2, 3 } };
	out.problem.velocities.resize(out.problem.bodyCount());
	out.warmStart = { { 4, 5, 6 } };
	write(path, out);
	const RecordedProblem in = read(path);
	ASSERT_EQ(in.problem.contactCount(), 1u);
	EXPECT_EQ(in.problem.contacts[0].i, 1);
	EXPECT_EQ(in.problem.contacts[0].j, 2);
	for (double Contact::*const x : numbers)
		EXPECT_EQ(in.problem.contacts[0].*x, c.*x) << "where " << c.*x << " was";
	EXPECT_TRUE(sameBits(in.problem.impulses, out.problem.impulses));
	EXPECT_TRUE(sameBits(in.warmStart, out.warmStart));
}

TEST_F(ProblemFile, AnEmptyProblemIsOneToo)
{
	write(path, { {}, {}, step });
	EXPECT_EQ(read(path).problem.contactCount(), 0u);
}

TEST_F(ProblemFile, RefusesWhatIsNotOne)
{
	EXPECT_NE(complaint().find("cannot be read (No such file or directory)"), std::string::npos) << complaint();
	std::ofstream(path) << "no HDF5";
	EXPECT_NE(complaint().find(path + ": cannot be read as an HDF5 file"), std::string::npos) << complaint();

	RecordedProblem out { lattice(4, 2).problem, {}, step };
	out.problem.velocities.resize(out.problem.bodyCount());
	out.warmStart.resize(3); // too short
	write(path, out);
	EXPECT_NE(complaint().find("warm_start has 3 rows"), std::string::npos) << complaint();
	std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
	EXPECT_NE(complaint().find(path), std::string::npos) << complaint();
}

TEST_F(ProblemFile, RefusesBodiesThatAreNotThereAndStepsThatAreNone)
{
	RecordedProblem out { lattice(4, 2).problem, {}, step };
	out.problem.velocities.resize(out.problem.bodyCount());
	out.warmStart = out.problem.impulses;
	write(path, out);
	EXPECT_EQ(complaint(), "");
	out.problem.contacts[3].j = 1000;
	write(path, out);
	EXPECT_NE(complaint().find("contact 3 names body 1000: there are 9, counted from 0"), std::string::npos)
	        << complaint();
	out.problem.contacts[3].j = -1;
	write(path, out);
	EXPECT_NE(complaint().find("contact 3 names body -1"), std::string::npos) << complaint();
	for (const double h : { 0.0, -1.0, std::nan("") }) {
		write(path, { {}, {}, h });
		EXPECT_NE(complaint().find("time_step"), std::string::npos) << complaint();
	}
}

/// What writing to a path complains about.
std::string refusal(const std::string& path)
{
	try {
		write(path, { lattice(4, 2).problem, {}, step });
	} catch (const std::runtime_error& error) {
		return error.what();
	}
	return "written";
}

TEST_F(ProblemFile, SaysWhereItCannotWrite)
{
	const std::string nowhere = (folder / "nowhere" / "step.h5").string(), text = refusal(nowhere);
	EXPECT_NE(text.find(nowhere + ": cannot be written (No such file or directory)"), std::string::npos) << text;
	EXPECT_NE(text.find("choose a folder"), std::string::npos) << text;
}

TEST_F(ProblemFile, LeavesNothingBehindWhereItFails)
{
	std::filesystem::create_directory(path); // cannot be replaced by a file
	EXPECT_NE(refusal(path).find("cannot be written (Is a directory)"), std::string::npos) << refusal(path);
	EXPECT_EQ(names(), std::vector<std::string> { "step.h5" });
}

// a disk without room, as far as a process may have one
TEST_F(ProblemFile, AFullDiskIsOneMessageAndTheOldFileStays)
{
	std::ofstream(path) << "the old one";
	rlimit before {};
	ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
	rlimit small   = before;
	small.rlim_cur = 2000; // bytes; the file has some ten thousand
	const auto old = std::signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &small);
	const std::string text = refusal(path);
	setrlimit(RLIMIT_FSIZE, &before);
	std::signal(SIGXFSZ, old);
	EXPECT_NE(text.find("cannot be written (File too large)"), std::string::npos) << text;
	EXPECT_EQ(names(), std::vector<std::string> { "step.h5" });
	EXPECT_EQ(std::filesystem::file_size(path), 11u);
}

// who can write into the folder (/tmp) could have put a link where the part goes, or where the file goes
TEST_F(ProblemFile, FollowsNoLink)
{
	const std::filesystem::path victim = folder / "victim";
	std::ofstream(victim) << "precious";
	std::filesystem::create_symlink(victim, path);
	std::filesystem::create_symlink(victim, path + ".part"); // a name that could be known
	EXPECT_EQ(refusal(path), "written");
	EXPECT_FALSE(std::filesystem::is_symlink(path));
	EXPECT_EQ(std::filesystem::file_size(victim), 8u);
	EXPECT_EQ(
	        complaint(),
	        "contact problem " + path + ": /bodies/velocity has 0 rows where 9 are needed"); // ours, and HDF5
}

} // namespace
