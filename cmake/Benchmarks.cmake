# Kernel benchmarks with Google Benchmark, where it is there; no part of ctest, which asserts no wall time.

option(NONSMOOTH_BENCHMARKS "Build the kernel benchmarks, where Google Benchmark is there" ON)
if(NONSMOOTH_BENCHMARKS)
    find_package(benchmark QUIET)
    if(benchmark_FOUND)
        file(GLOB benchmark_sources CONFIGURE_DEPENDS tests/benchmark/*.cpp)
        add_executable(contact_benchmarks ${benchmark_sources})
        target_link_libraries(contact_benchmarks PRIVATE nonsmooth_contact nonsmooth_flags benchmark::benchmark benchmark::benchmark_main)
        target_include_directories(contact_benchmarks PRIVATE tests/benchmark tests/contact)
    else()
        message(STATUS "Google Benchmark not found (libbenchmark-dev): without contact_benchmarks")
    endif()
endif()
