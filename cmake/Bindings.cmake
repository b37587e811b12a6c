# The solver for Python without YADE: build/python on the PYTHONPATH gives `import nonsmooth.contact`.

find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 REQUIRED CONFIG)
set(NONSMOOTH_PYTHON "${CMAKE_BINARY_DIR}/python")
# Of sources in pkg/bindings, a list, the module that Python imports as `name`, and the libraries it needs.
function(nonsmooth_python_module name sources)
    set(target "${name}_module")
    string(REGEX REPLACE "^_" "" target "${target}")
    list(TRANSFORM sources PREPEND "${CMAKE_SOURCE_DIR}/pkg/bindings/")
    pybind11_add_module(${target} MODULE ${sources})
    target_link_libraries(${target} PRIVATE ${ARGN} nonsmooth_flags)
    target_compile_definitions(${target} PRIVATE "NONSMOOTH_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}\"")
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY "${NONSMOOTH_PYTHON}")
    if(NONSMOOTH_PLUGIN)
        # YADE has its folder py on the path
        set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${plugin_dir}/py")
        get_filename_component(module "${name}${PYTHON_MODULE_EXTENSION}" NAME)
        file(CREATE_LINK "${plugin_dir}/py/${module}" "${NONSMOOTH_PYTHON}/${module}" SYMBOLIC)
        install(TARGETS ${target} LIBRARY DESTINATION "${YADE_SUBDIR}/py")
    endif()
endfunction()
# the source folder itself, so that edits need no build
file(MAKE_DIRECTORY "${NONSMOOTH_PYTHON}")
file(CREATE_LINK "${CMAKE_SOURCE_DIR}/py/nonsmooth" "${NONSMOOTH_PYTHON}/nonsmooth" SYMBOLIC)
nonsmooth_python_module(_nonsmooth_contact "contact_module.cpp;plane_problem.cpp;space_problem.cpp" nonsmooth_contact)
nonsmooth_python_module(_nonsmooth_slip slip_module.cpp nonsmooth_slip)
nonsmooth_python_module(_nonsmooth_packing packing_module.cpp nonsmooth_packing)
