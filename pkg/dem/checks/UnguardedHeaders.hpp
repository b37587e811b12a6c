// Headers of YADE's that have no guard of their own: two sources that include one may be compiled as one.
#pragma once

#include <pkg/dem/DomainLimiter.hpp>
