# ctest: other builds of the solver, by which errors show that its tests do not see. Each works in a folder of its own and needs nothing of YADE.

option(NONSMOOTH_CHECKS "Test the solver with sanitizers too, and compile it for another processor" ON)
if(NONSMOOTH_CHECKS)
    # two or three minutes the first time: its own build of the solver, its tests and the binding
    add_test(NAME sanitizers COMMAND "${CMAKE_SOURCE_DIR}/tests/sanitizers/run.sh" "${CMAKE_BINARY_DIR}/sanitizers")
    set_tests_properties(sanitizers PROPERTIES LABELS sanitizers TIMEOUT 1200 COST 120) # the longest first

    add_test(NAME formatted COMMAND "${CMAKE_SOURCE_DIR}/scripts/format.sh" --check)
    set_tests_properties(formatted PROPERTIES LABELS formatted TIMEOUT 300 SKIP_RETURN_CODE 77) # other versions than Debian 12 has

    find_program(NONSMOOTH_AARCH64_COMPILER aarch64-linux-gnu-g++)
    if(NONSMOOTH_AARCH64_COMPILER)
        list(GET HDF5_INCLUDE_DIRS 0 hdf5_headers)
        add_test(NAME aarch64 COMMAND "${CMAKE_SOURCE_DIR}/tests/aarch64/compile.sh" "${NONSMOOTH_AARCH64_COMPILER}" "${CMAKE_BINARY_DIR}/aarch64" "${hdf5_headers}")
        set_tests_properties(aarch64 PROPERTIES LABELS aarch64 TIMEOUT 300 COST 20)
    else()
        message(STATUS "aarch64-linux-gnu-g++ not found (g++-aarch64-linux-gnu): without the test aarch64")
    endif()
endif()
