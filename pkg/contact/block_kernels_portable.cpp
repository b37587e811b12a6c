#include "block_kernels.inc"

namespace nonsmooth::contact {

const BlockKernels& portableKernels()
{
	static const BlockKernels kernels { "portable", sweepBlocks, sweepBlocksAndFetch, applyBlocks, measureBlocks, extrapolateBodies };
	return kernels;
}

#ifdef NONSMOOTH_AVX2
const BlockKernels& avx2Kernels(); // block_kernels_avx2.cpp
#endif

const BlockKernels& bestKernels()
{
#ifdef NONSMOOTH_AVX2
	if (__builtin_cpu_supports("avx2")) return avx2Kernels();
#endif
	return portableKernels();
}

} // namespace nonsmooth::contact
