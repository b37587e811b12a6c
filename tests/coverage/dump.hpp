// Included into every source of the coverage build: YADE's process ends without what a library writes at its end, so sitecustomize.py calls this.
#pragma once

extern "C" {
void                       __gcov_dump();
__attribute__((weak)) void nonsmooth_dump_coverage() { __gcov_dump(); }
}
