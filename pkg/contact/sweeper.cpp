#include <contact/law.hpp>
#include <contact/sweeper.tpp>

namespace nonsmooth::contact {

template class Sweeper<Plane, double>;
template class Sweeper<Plane, float>;

} // namespace nonsmooth::contact
