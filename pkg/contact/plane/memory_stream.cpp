#include <contact/plane/memory_stream.hpp>

namespace nonsmooth::contact {

#ifdef NONSMOOTH_AVX
// as wide as the loops that are held against it, else instructions and not memory would set the rate in a cache
__attribute__((target_clones("avx2", "default")))
#endif
void MemoryStream::pass()
{
	// tends to 2: no number becomes too small for fast arithmetic, however many passes there are
	for (Motion<double>& m : numbers)
		m.v = 0.5 * m.v + 1.0;
}

} // namespace nonsmooth::contact
