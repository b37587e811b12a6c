# Finds an installed YADE and the headers of the same version.
#
#   YADE_PREFIX    the install, e.g. /usr (cache variable or environment)
#   YADE_HEADERS   the unpacked YADE sources, whose core/, lib/ and pkg/ are the headers
#                  (cache variable or environment; Debian installs none)
#
# Sets YADE_FOUND, YADE_VERSION, YADE_FEATURES, YADE_PREFIX, YADE_LIBRARY_DIR, YADE_SUBDIR (the
# library folder below the prefix), YADE_PROGRAM, YADE_PYTHON, and the imported target YADE::YADE.
#
# YADE's class layouts depend on its feature macros, so these are read from the install, never
# guessed: a plugin compiled with others loads and then corrupts memory.

foreach(_name YADE_PREFIX YADE_HEADERS)
    if(NOT ${_name} AND DEFINED ENV{${_name}})
        set(${_name} "$ENV{${_name}}")
    endif()
endforeach()
set(YADE_PREFIX "${YADE_PREFIX}" CACHE PATH "The YADE install to build for")
set(YADE_HEADERS "${YADE_HEADERS}" CACHE PATH "The unpacked YADE sources: core/, lib/, pkg/")

# ---- the install: libraries, program, interpreter -----------------------------------------------
set(_yade_reason "")
set(_yade_config "")
unset(_yade_headers_ok)
foreach(_prefix "${YADE_PREFIX}" /usr /usr/local)
    if(NOT _prefix OR _yade_config)
        continue()
    endif()
    foreach(_lib lib "lib/${CMAKE_LIBRARY_ARCHITECTURE}" lib64)
        # unsuffixed first: yade, then yade-2025.2.0 and the like
        file(GLOB _suffixed "${_prefix}/${_lib}/yade-*/py/yade/config.py")
        foreach(_file "${_prefix}/${_lib}/yade/py/yade/config.py" ${_suffixed})
            if(NOT _yade_config AND EXISTS "${_file}")
                set(_yade_config "${_file}")
                set(_yade_root "${_prefix}")
            endif()
        endforeach()
    endforeach()
    if(YADE_PREFIX)
        break() # a given prefix is meant: no fallback to another install
    endif()
endforeach()
if(NOT _yade_config)
    set(_yade_reason "no YADE was found in '${YADE_PREFIX}': give the install with -DYADE_PREFIX=…, or have scripts/setup.sh provide one")
endif()

if(_yade_config)
    get_filename_component(YADE_LIBRARY_DIR "${_yade_config}/../../.." ABSOLUTE)
    get_filename_component(_yade_name "${YADE_LIBRARY_DIR}" NAME)
    get_filename_component(_yade_root "${_yade_root}" ABSOLUTE)
    file(RELATIVE_PATH YADE_SUBDIR "${_yade_root}" "${YADE_LIBRARY_DIR}")
    set(YADE_PREFIX "${_yade_root}" CACHE PATH "The YADE install to build for" FORCE)
    set(YADE_PROGRAM "${YADE_PREFIX}/bin/${_yade_name}")
    # YADE runs in the interpreter its program names, whatever python comes first in PATH
    set(YADE_PYTHON /usr/bin/python3)
    if(EXISTS "${YADE_PROGRAM}")
        file(STRINGS "${YADE_PROGRAM}" _shebang LIMIT_COUNT 1)
        if(_shebang MATCHES "^#! *(/[^ ]*python[0-9.]*)$")
            set(YADE_PYTHON "${CMAKE_MATCH_1}")
        endif()
    endif()
    execute_process(
        COMMAND "${YADE_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/yade_install.py" query "${_yade_config}"
        OUTPUT_VARIABLE _answer ERROR_VARIABLE _error RESULT_VARIABLE _result)
    if(NOT _result EQUAL 0)
        message(FATAL_ERROR "${_yade_config} could not be read by ${YADE_PYTHON}:\n${_error}")
    endif()
    foreach(_key version features realBits realDigits mpmath python)
        string(REGEX MATCH "(^|\n)${_key}=([^\n]*)" _line "${_answer}")
        set(_yade_${_key} "${CMAKE_MATCH_2}")
    endforeach()
    set(YADE_VERSION "${_yade_version}")
    set(YADE_FEATURES "${_yade_features}")
    if(NOT _yade_realBits EQUAL 64)
        message(FATAL_ERROR "YADE in ${YADE_PREFIX} computes with ${_yade_realBits}-bit numbers; this plugin supports 64-bit (double) only")
    endif()

    # ---- the headers, which must be of the same version -----------------------------------------
    if(NOT EXISTS "${YADE_HEADERS}/core/Scene.hpp")
        set(_yade_reason "'${YADE_HEADERS}' holds no YADE headers (core/Scene.hpp): give the unpacked sources of YADE ${YADE_VERSION} with -DYADE_HEADERS=…")
    elseif(NOT EXISTS "${YADE_HEADERS}/RELEASE")
        set(_yade_reason "'${YADE_HEADERS}' has no RELEASE file, so its version is unknown: give the sources of the release ${YADE_VERSION}")
    else()
        file(STRINGS "${YADE_HEADERS}/RELEASE" _headers_version LIMIT_COUNT 1)
        string(STRIP "${_headers_version}" _headers_version)
        if(NOT _headers_version STREQUAL YADE_VERSION)
            message(FATAL_ERROR
                "YADE's version and that of its headers differ: ${YADE_PREFIX} holds YADE ${YADE_VERSION}, "
                "but ${YADE_HEADERS} holds the headers of ${_headers_version}. A plugin built so would crash. "
                "Give the sources of ${YADE_VERSION} with -DYADE_HEADERS=…, or another install with -DYADE_PREFIX=…")
        endif()
        set(_yade_headers_ok TRUE)
    endif()
endif()

# ---- features to macros, as in YADE's own CMakeLists.txt ------------------------------------------
# FEATURE:MACRO,MACRO; a feature without macros changes no header.
set(_yade_macros
    LOGGER:YADE_BOOST_LOG,BOOST_LOG_DYN_LINK COMPLEX_MP:YADE_COMPLEX_MP MPFR:YADE_MPFR MPC:
    VTK:YADE_VTK OPENMP:YADE_OPENMP GTS:YADE_GTS QT5:YADE_OPENGL,YADE_QT5,QT_NO_KEYWORDS
    CGAL:YADE_CGAL,CGAL_DISABLE_ROUNDING_MATH_CHECK PFVFLOW:FLOW_ENGINE LINSOLV:LINSOLV
    CHOLMOD_GPU:PFV_GPU MPI:YADE_MPI TWOPHASEFLOW:TWOPHASEFLOW SPH:YADE_SPH LS_DEM:YADE_LS_DEM
    DEFORM:YADE_DEFORM FEMLIKE:YADE_FEM LIQMIGRATION:YADE_LIQMIGRATION GL2PS:YADE_GL2PS
    LBMFLOW:LBM_ENGINE MASK_ARBITRARY:YADE_MASK_ARBITRARY,YADE_MASK_ARBITRARY_SIZE=256
    THERMAL:THERMAL PARTIALSAT:PARTIALSAT PROFILING:USE_TIMING_DELTAS,ISC_TIMING
    POTENTIAL_PARTICLES:YADE_POTENTIAL_PARTICLES POTENTIAL_BLOCKS:YADE_POTENTIAL_BLOCKS
    VECTORIZE: USEFUL_ERRORS: FAST_NATIVE: ASAN: OAR:)

set(YADE_DEFINITIONS MAX_LOG_LEVEL=5 YADE_ODEINT
    "YADE_REAL_BIT=${_yade_realBits}" "YADE_REAL_DEC=${_yade_realDigits}")
# The only trace that RealHP<N> leaves in an install of doubles is that it needs mpmath.
if(NOT _yade_mpmath)
    list(APPEND YADE_DEFINITIONS YADE_DISABLE_REAL_MULTI_HP)
endif()
if(NOT "VECTORIZE" IN_LIST YADE_FEATURES)
    list(APPEND YADE_DEFINITIONS EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|mips64|ppc64le|s390x)")
    list(APPEND YADE_DEFINITIONS YADE_FLOAT128_UNAVAILABLE)
endif()
foreach(_feature IN LISTS YADE_FEATURES)
    set(_known FALSE)
    foreach(_entry IN LISTS _yade_macros)
        if(_entry MATCHES "^${_feature}:(.*)$")
            set(_known TRUE)
            string(REPLACE "," ";" _list "${CMAKE_MATCH_1}")
            list(APPEND YADE_DEFINITIONS ${_list})
        endif()
    endforeach()
    if(NOT _known)
        message(WARNING "YADE's feature ${_feature} is unknown here; the plugin will check YADE's class layout when it loads")
    endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(YADE
    REQUIRED_VARS YADE_LIBRARY_DIR YADE_HEADERS _yade_headers_ok
    VERSION_VAR YADE_VERSION
    REASON_FAILURE_MESSAGE "${_yade_reason}")

# ---- the imported target --------------------------------------------------------------------------
if(YADE_FOUND AND NOT TARGET YADE::YADE)
    set(Python3_EXECUTABLE "${YADE_PYTHON}")
    find_package(Python3 "${_yade_python}" EXACT REQUIRED COMPONENTS Interpreter Development NumPy)
    find_package(Eigen3 REQUIRED NO_MODULE)
    find_package(OpenMP REQUIRED COMPONENTS CXX)
    string(REPLACE "." "" _digits "${_yade_python}")
    find_package(Boost REQUIRED COMPONENTS "python${_digits}" serialization iostreams filesystem thread log)

    add_library(YADE::YADE INTERFACE IMPORTED)
    target_include_directories(YADE::YADE SYSTEM INTERFACE "${YADE_HEADERS}")
    target_compile_definitions(YADE::YADE INTERFACE ${YADE_DEFINITIONS})
    target_compile_features(YADE::YADE INTERFACE cxx_std_17)
    foreach(_library yade pkg_common pkg_dem)
        if(NOT EXISTS "${YADE_LIBRARY_DIR}/lib${_library}.so")
            message(FATAL_ERROR "the YADE install lacks ${YADE_LIBRARY_DIR}/lib${_library}.so")
        endif()
        target_link_libraries(YADE::YADE INTERFACE "${YADE_LIBRARY_DIR}/lib${_library}.so")
    endforeach()
    target_link_libraries(YADE::YADE INTERFACE
        Boost::headers "Boost::python${_digits}" Boost::serialization Boost::iostreams Boost::filesystem
        Boost::thread Boost::log Python3::Python Eigen3::Eigen OpenMP::OpenMP_CXX)
    # YADE's headers are meant to be read with this: without it, compiling takes much more memory.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(YADE::YADE INTERFACE -ftrack-macro-expansion=0)
    endif()
    if("MPI" IN_LIST YADE_FEATURES)
        find_package(MPI REQUIRED COMPONENTS CXX)
        target_link_libraries(YADE::YADE INTERFACE MPI::MPI_CXX)
    endif()
endif()
