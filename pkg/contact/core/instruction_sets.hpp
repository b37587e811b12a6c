// Which of the loops over blocks (kernel_table.hpp) the present processor can run.
#pragma once

namespace nonsmooth::contact {

enum class InstructionSet { Avx2, Avx512 };

/// Whether the loops compiled for that set can run here; without them in the build, or on another kind of processor,
/// no.
bool runs(InstructionSet set);

} // namespace nonsmooth::contact
