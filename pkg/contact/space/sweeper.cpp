#include <contact/space/sweeper.hpp>
#include <contact/sweeper.tpp>

namespace nonsmooth::contact {

template class Sweeper<space::Space, double>;
template class Sweeper<space::Space, float>;

} // namespace nonsmooth::contact
