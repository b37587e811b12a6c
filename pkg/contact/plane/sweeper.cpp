#include <contact/plane/law.hpp>
#include <contact/plane/solver.hpp>
#include <contact/core/sweeper.tpp>

namespace nonsmooth::contact {

template class Sweeper<Plane, double>;
template class Sweeper<Plane, float>;

} // namespace nonsmooth::contact
