# The documentation, where any warning is an error: the target "doc", and a test that builds it.

if(NONSMOOTH_PLUGIN AND EXISTS "${CMAKE_SOURCE_DIR}/doc/conf.py")
    set(sphinx_command "${CMAKE_COMMAND}" -E env "NONSMOOTH_BUILD=${CMAKE_BINARY_DIR}"
        "${CMAKE_SOURCE_DIR}/scripts/yade-nonsmooth" "${CMAKE_SOURCE_DIR}/cmake/sphinx_build.py"
        -W --keep-going -q -E -b html -d "${CMAKE_BINARY_DIR}/doc/doctrees"
        "${CMAKE_SOURCE_DIR}/doc" "${CMAKE_BINARY_DIR}/doc/html")
    add_custom_target(doc COMMAND ${sphinx_command} VERBATIM)
    add_dependencies(doc nonsmooth_gate nonsmooth_engines)
    if(NONSMOOTH_TESTS)
        add_test(NAME documentation COMMAND ${sphinx_command})
        set_tests_properties(documentation PROPERTIES LABELS doc TIMEOUT 900 COST 60)
        # the script of the README, word for word (doc/ext/checked_script.py)
        add_test(NAME readme_script COMMAND "${CMAKE_SOURCE_DIR}/scripts/yade-nonsmooth"
            "${CMAKE_SOURCE_DIR}/doc/examples/falling_block.py" --threads 1)
        set_tests_properties(readme_script PROPERTIES LABELS doc TIMEOUT 300 ENVIRONMENT "NONSMOOTH_BUILD=${CMAKE_BINARY_DIR}")
    endif()
endif()
