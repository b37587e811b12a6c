#include <contact/core/contact_blocks.tpp>
#include <contact/plane/solver.hpp>

namespace nonsmooth::contact {

template void layOut<Plane>(const Problem&, int, ContactBlocks&, bool);
template void fillIn<Plane>(const Problem&, const BlockKernels&, std::size_t, ContactBlocks&);

} // namespace nonsmooth::contact
