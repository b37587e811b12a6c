// Compiled with -mavx2 (CMakeLists.txt); empty elsewhere.
#ifdef __AVX2__
#include "block_kernels.inc"

namespace nonsmooth::contact {

const BlockKernels& avx2Kernels();
const BlockKernels& avx2Kernels()
{
	static const BlockKernels kernels { "avx2", sweepBlocks, sweepBlocksAndFetch, applyBlocks, measureBlocks, extrapolateBodies };
	return kernels;
}

} // namespace nonsmooth::contact
#endif
