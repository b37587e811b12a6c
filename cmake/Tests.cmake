# ctest: the solver's tests, those that run in YADE, and (Documentation.cmake) the documentation.

find_package(GTest REQUIRED)
find_package(ZLIB REQUIRED) # reads tests/data
include(GoogleTest)
file(GLOB contact_tests CONFIGURE_DEPENDS tests/contact/*.cpp tests/contact/space/*.cpp tests/neighbours/*.cpp tests/packing/*.cpp)
find_package(Eigen3 QUIET NO_MODULE)
if(NOT TARGET Eigen3::Eigen)
    message(STATUS "Eigen not found (libeigen3-dev): without tests/contact/plane_bits_test.cpp")
    list(FILTER contact_tests EXCLUDE REGEX "/plane_bits_test\\.cpp$")
endif()
if(contact_tests)
    add_executable(contact_tests ${contact_tests})
    target_link_libraries(contact_tests PRIVATE nonsmooth_contact nonsmooth_neighbours nonsmooth_slip nonsmooth_packing nonsmooth_flags GTest::gtest GTest::gtest_main ZLIB::ZLIB)
    target_include_directories(contact_tests PRIVATE tests/contact)
    if(TARGET Eigen3::Eigen) # YADE computes with it, and without its vectorisation
        target_link_libraries(contact_tests PRIVATE Eigen3::Eigen)
        set_source_files_properties(tests/contact/plane_bits_test.cpp PROPERTIES COMPILE_DEFINITIONS EIGEN_DONT_VECTORIZE)
    endif()
    gtest_discover_tests(contact_tests DISCOVERY_TIMEOUT 60 PROPERTIES LABELS contact TIMEOUT 600)
endif()

# What is in Python without YADE: the binding, the generators of random mutants, and sections, packings and contact problems broken in many ways.
function(nonsmooth_python_test name path)
    add_test(NAME ${name} COMMAND "${Python3_EXECUTABLE}" -m pytest -q -p no:cacheprovider "${CMAKE_SOURCE_DIR}/${path}")
    set_tests_properties(${name} PROPERTIES LABELS ${name} TIMEOUT 600 COST 30 ENVIRONMENT "PYTHONPATH=${NONSMOOTH_PYTHON}")
endfunction()
nonsmooth_python_test(bindings tests/bindings)
nonsmooth_python_test(generators tests/mutants)
execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import hypothesis, h5py" RESULT_VARIABLE without_hypothesis ERROR_QUIET)
if(without_hypothesis)
    message(STATUS "Hypothesis or h5py not found (python3-hypothesis, python3-h5py): without the test fuzz")
else()
    nonsmooth_python_test(fuzz tests/fuzz)
endif()

if(NONSMOOTH_PLUGIN)
    # A gate whose class layout is wrong on purpose, as if the macros had been guessed: the gate must
    # notice (tests/yade/dem/test_load.py).
    nonsmooth_gate(nonsmooth_gate_wrong)
    set_target_properties(nonsmooth_gate_wrong PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/wrong_layout")
    if("QT5" IN_LIST YADE_FEATURES)
        target_compile_options(nonsmooth_gate_wrong PRIVATE -UYADE_OPENGL)
    else()
        target_compile_options(nonsmooth_gate_wrong PRIVATE -DYADE_OPENGL)
    endif()

    # What a viewer does to the list of interactions, which slim builds of YADE have not (tests/yade/dem/test_engine.py).
    add_library(nonsmooth_drawing_lock SHARED tests/yade/drawing_lock.cpp)
    target_link_libraries(nonsmooth_drawing_lock PRIVATE nonsmooth_yade)
    set_target_properties(nonsmooth_drawing_lock PROPERTIES NONSMOOTH_UNOPTIMISED ON)

    # pytest runs inside YADE: the tests see YADE as its users' scripts do. Two processes of one thread share the files of tests.
    set(shared "${CMAKE_BINARY_DIR}/tests_taken")
    add_test(NAME yade_begin COMMAND "${CMAKE_COMMAND}" -E rm -rf "${shared}")
    set_tests_properties(yade_begin PROPERTIES LABELS yade FIXTURES_SETUP tests_taken)
    foreach(part 1 2)
        add_test(NAME yade_${part} COMMAND "${CMAKE_SOURCE_DIR}/scripts/yade-nonsmooth" "${CMAKE_SOURCE_DIR}/tests/yade/run_pytest.py" --threads 1 --share "${shared}")
        set_tests_properties(yade_${part} PROPERTIES LABELS yade TIMEOUT 3600 FIXTURES_REQUIRED tests_taken
            ENVIRONMENT "NONSMOOTH_BUILD=${CMAKE_BINARY_DIR}")
    endforeach()

    # The software broken on purpose, in copies: the tests must notice. Builds the plugin a second time.
    add_test(NAME mutants COMMAND "${YADE_PYTHON}" "${CMAKE_SOURCE_DIR}/tests/mutants/run.py" "${CMAKE_BINARY_DIR}")
    set_tests_properties(mutants PROPERTIES LABELS mutants TIMEOUT 3600 RUN_SERIAL ON)
endif()
