// Which of the loops over blocks (kernel_table.hpp) the present processor can run.
#pragma once

#include <vector>

namespace nonsmooth::contact {

enum class InstructionSet { Avx2, Avx512 };

/// Whether the loops compiled for that set can run here; without them in the build, or on another kind of processor,
/// no.
bool runs(InstructionSet set);

/// Those of a dimension's kernels that can run here, the fastest first; null: not in this build.
template <class Kernels>
std::vector<const Kernels*> runnable(const Kernels* avx512, const Kernels* avx2, const Kernels& portable)
{
	std::vector<const Kernels*> found;
	if (avx512 && runs(InstructionSet::Avx512)) found.push_back(avx512);
	if (avx2 && runs(InstructionSet::Avx2)) found.push_back(avx2);
	found.push_back(&portable);
	return found;
}

} // namespace nonsmooth::contact
