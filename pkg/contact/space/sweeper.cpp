#include <contact/space/sweeper.hpp>
#include <contact/core/sweeper.tpp>

namespace nonsmooth::contact {

template class Sweeper<space::Space, double>;
template class Sweeper<space::Space, float>;

} // namespace nonsmooth::contact
