# The YADE plugin, in two libraries.
#
#   libnonsmooth.so        the gate. YADE loads every lib*.so of its library folder and aborts when one
#                          fails, so this one always loads. It checks YADE's class layout, and only then
#                          opens the other.
#   nonsmooth_engines.so   the engines. Its name lacks "lib" so that YADE leaves it to the gate.

find_package(YADE REQUIRED)
message(STATUS "YADE ${YADE_VERSION} in ${YADE_PREFIX}, features: ${YADE_FEATURES}")
if(CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
    set(CMAKE_INSTALL_PREFIX "${YADE_PREFIX}" CACHE PATH "Where to install: the YADE install" FORCE)
endif()

# A prefix of links to the install plus the plugin: YADE with the plugin, without root.
set(NONSMOOTH_PREFIX "${CMAKE_BINARY_DIR}/prefix")
set(plugin_dir "${NONSMOOTH_PREFIX}/${YADE_SUBDIR}")
execute_process(
    COMMAND "${YADE_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/yade_install.py" prefix "${YADE_LIBRARY_DIR}" "${plugin_dir}"
    COMMAND_ERROR_IS_FATAL ANY)
get_filename_component(yade_name "${YADE_PROGRAM}" NAME)
foreach(suffix "" "-batch")
    set(program "${YADE_PROGRAM}${suffix}")
    configure_file("${CMAKE_CURRENT_LIST_DIR}/yade.in" "${NONSMOOTH_PREFIX}/bin/${yade_name}${suffix}" @ONLY
        FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    if(NOT yade_name STREQUAL "yade") # the launcher knows one name
        file(CREATE_LINK "${yade_name}${suffix}" "${NONSMOOTH_PREFIX}/bin/yade${suffix}" SYMBOLIC)
    endif()
endforeach()
# the source folder itself, so that edits need no build
file(CREATE_LINK "${CMAKE_SOURCE_DIR}/py/nonsmooth" "${plugin_dir}/py/yade/nonsmooth" SYMBOLIC)

# The flags every library of the plugin shares: how YADE's headers are to be read.
add_library(nonsmooth_yade INTERFACE)
target_include_directories(nonsmooth_yade INTERFACE "${CMAKE_SOURCE_DIR}/pkg")
target_link_libraries(nonsmooth_yade INTERFACE nonsmooth_flags YADE::YADE)
# -O2 and no more: these translation units are mostly YADE's templates. No visibility flags: YADE
# needs one typeinfo of each class across all libraries. What computes nothing (the gate, the tests' own libraries) is compiled at -O0,
# in two thirds of the time.
set(unoptimised "$<BOOL:$<TARGET_PROPERTY:NONSMOOTH_UNOPTIMISED>>")
target_compile_options(nonsmooth_yade INTERFACE $<$<CONFIG:Release>:-O2> $<${unoptimised}:-O0> -Wno-unused-parameter)
# quiet about what YADE's headers include
target_compile_definitions(nonsmooth_yade INTERFACE BOOST_ALLOW_DEPRECATED_HEADERS BOOST_BIND_GLOBAL_PLACEHOLDERS)

list(JOIN YADE_FEATURES " " features)
set(gate_definitions "NONSMOOTH_YADE_VERSION=\"${YADE_VERSION}\"" "NONSMOOTH_YADE_FEATURES=\"${features}\"")

function(nonsmooth_gate target)
    add_library(${target} SHARED "${CMAKE_SOURCE_DIR}/pkg/dem/checks/LayoutCheck.cpp")
    target_link_libraries(${target} PRIVATE nonsmooth_yade ${CMAKE_DL_LIBS})
    target_compile_definitions(${target} PRIVATE ${gate_definitions})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME nonsmooth NONSMOOTH_UNOPTIMISED ON)
endfunction()
nonsmooth_gate(nonsmooth_gate)

# A translation unit that includes YADE's headers takes 30 s before its own code: two large ones, or one a core where memory holds them (3 GB each).
file(GLOB_RECURSE engine_sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/pkg/dem/*.cpp")
list(FILTER engine_sources EXCLUDE REGEX "/LayoutCheck\\.cpp$")
if(NOT engine_sources)
    file(WRITE "${CMAKE_BINARY_DIR}/no_engines.cpp" "// pkg/dem holds no engines yet\n")
    set(engine_sources "${CMAKE_BINARY_DIR}/no_engines.cpp")
endif()
if(NOT DEFINED NONSMOOTH_UNITY_BATCH)
    cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
    cmake_host_system_information(RESULT megabytes QUERY TOTAL_PHYSICAL_MEMORY)
    list(LENGTH engine_sources sources)
    if(cores LESS 2 OR megabytes LESS 7000)
        set(cores 6) # of which ninja compiles one or two at a time, in half the memory
    elseif(cores GREATER 6)
        set(cores 6)
    endif()
    math(EXPR batch "(${sources} + ${cores} - 1) / ${cores}")
    set(NONSMOOTH_UNITY_BATCH "${batch}" CACHE STRING "How many sources with YADE's headers are compiled as one")
endif()
add_library(nonsmooth_engines SHARED ${engine_sources})
target_link_libraries(nonsmooth_engines PRIVATE nonsmooth_contact nonsmooth_neighbours nonsmooth_slip nonsmooth_yade)
set_target_properties(nonsmooth_engines PROPERTIES PREFIX ""
    UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE "${NONSMOOTH_UNITY_BATCH}")

set_target_properties(nonsmooth_gate nonsmooth_engines PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY "${plugin_dir}"
    BUILD_RPATH "${YADE_LIBRARY_DIR}" INSTALL_RPATH "$ORIGIN")

install(TARGETS nonsmooth_gate nonsmooth_engines LIBRARY DESTINATION "${YADE_SUBDIR}")
install(DIRECTORY "${CMAKE_SOURCE_DIR}/py/nonsmooth" DESTINATION "${YADE_SUBDIR}/py/yade"
    PATTERN "__pycache__" EXCLUDE)
