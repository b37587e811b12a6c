// Compiled with -mavx2 (CMakeLists.txt); empty elsewhere.
#ifdef __AVX2__
#include "block_kernels.inc"

namespace nonsmooth::contact {

const BlockKernels& avx2Kernels()
{
	static const BlockKernels kernels = kernelsOf("avx2");
	return kernels;
}

} // namespace nonsmooth::contact
#endif
