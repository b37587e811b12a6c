# Siconos as an oracle: oracle/siconos_solve solves a recorded contact problem with a solver that is not ours (tests/oracle). Left out where
# Debian's libsiconos-numerics-dev is not installed; its own CMake files ask for parts of Siconos that this package has not.

find_path(SICONOS_INCLUDE siconos/numerics/RollingFrictionContactProblem.h)
find_library(SICONOS_NUMERICS siconos_numerics)
find_library(SICONOS_EXTERNALS siconos_externals)
if(SICONOS_INCLUDE AND SICONOS_NUMERICS AND SICONOS_EXTERNALS)
    # the headers name no version: Debian's, or that of the library's name
    execute_process(COMMAND dpkg-query -W -f "\${Version}" libsiconos-numerics-dev
        OUTPUT_VARIABLE siconos_version ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT siconos_version)
        file(REAL_PATH "${SICONOS_NUMERICS}" siconos_version)
        get_filename_component(siconos_version "${siconos_version}" NAME)
    endif()
    message(STATUS "Siconos ${siconos_version}: building oracle/siconos_solve")
    add_executable(siconos_solve tests/oracle/siconos_solve.cpp tests/oracle/siconos.cpp
        tests/oracle/system.cpp tests/oracle/delassus.cpp)
    target_include_directories(siconos_solve PRIVATE tests/oracle)
    # Siconos includes its own headers without the folder
    target_include_directories(siconos_solve SYSTEM PRIVATE "${SICONOS_INCLUDE}" "${SICONOS_INCLUDE}/siconos" "${SICONOS_INCLUDE}/siconos/numerics")
    target_compile_definitions(siconos_solve PRIVATE "NONSMOOTH_SICONOS_VERSION=\"${siconos_version}\"")
    target_link_libraries(siconos_solve PRIVATE nonsmooth_contact nonsmooth_flags "${SICONOS_NUMERICS}" "${SICONOS_EXTERNALS}")
    set_target_properties(siconos_solve PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/oracle")
else()
    message(STATUS "Siconos not found (libsiconos-numerics-dev): without oracle/siconos_solve")
endif()
