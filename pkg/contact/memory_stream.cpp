#include <contact/memory_stream.hpp>

namespace nonsmooth::contact {

void MemoryStream::pass()
{
	// tends to 2: no number becomes too small for fast arithmetic, however many passes there are
	for (Motion& m : numbers)
		m.v = 0.5 * m.v + 1.0;
}

} // namespace nonsmooth::contact
