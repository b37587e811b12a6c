#include <contact/core/contact_blocks.tpp>
#include <contact/space/solver.hpp>

namespace nonsmooth::contact {

using space::Space;

template void layOut<Space>(const space::Problem&, int, space::ContactBlocks&, bool);
template void fillIn<Space>(const space::Problem&, const space::BlockKernels&, std::size_t, space::ContactBlocks&);

} // namespace nonsmooth::contact
