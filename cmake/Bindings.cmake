# The solver for Python without YADE: build/python on the PYTHONPATH gives `import nonsmooth.contact`.

find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 REQUIRED CONFIG)
set(NONSMOOTH_PYTHON "${CMAKE_BINARY_DIR}/python")
file(GLOB binding_sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/pkg/bindings/*.cpp")
pybind11_add_module(nonsmooth_contact_module MODULE ${binding_sources})
target_link_libraries(nonsmooth_contact_module PRIVATE nonsmooth_contact nonsmooth_flags)
target_compile_definitions(nonsmooth_contact_module PRIVATE "NONSMOOTH_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}\"")
set_target_properties(nonsmooth_contact_module PROPERTIES
    OUTPUT_NAME _nonsmooth_contact LIBRARY_OUTPUT_DIRECTORY "${NONSMOOTH_PYTHON}")
# the source folder itself, so that edits need no build
file(MAKE_DIRECTORY "${NONSMOOTH_PYTHON}")
file(CREATE_LINK "${CMAKE_SOURCE_DIR}/py/nonsmooth" "${NONSMOOTH_PYTHON}/nonsmooth" SYMBOLIC)
if(NONSMOOTH_PLUGIN)
    # YADE has its folder py on the path
    set_target_properties(nonsmooth_contact_module PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${plugin_dir}/py")
    get_filename_component(module "_nonsmooth_contact${PYTHON_MODULE_EXTENSION}" NAME)
    file(CREATE_LINK "${plugin_dir}/py/${module}" "${NONSMOOTH_PYTHON}/${module}" SYMBOLIC)
    install(TARGETS nonsmooth_contact_module LIBRARY DESTINATION "${YADE_SUBDIR}/py")
endif()
