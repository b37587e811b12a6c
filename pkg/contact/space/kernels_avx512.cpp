// Compiled with -mavx512f (CMakeLists.txt); empty elsewhere.
#ifdef __AVX512F__
#include "kernels.inc"

namespace nonsmooth::contact::space {

const BlockKernels& avx512Kernels()
{
	static const BlockKernels kernels = kernelsOf("avx512");
	return kernels;
}

} // namespace nonsmooth::contact::space
#endif
