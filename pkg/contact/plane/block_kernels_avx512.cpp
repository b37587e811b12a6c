// Compiled with -mavx512f (CMakeLists.txt); empty elsewhere.
#ifdef __AVX512F__
#include "block_kernels.inc"

namespace nonsmooth::contact {

const BlockKernels& avx512Kernels()
{
	static const BlockKernels kernels = kernelsOf("avx512");
	return kernels;
}

} // namespace nonsmooth::contact
#endif
