# Shortens the build of a slim YADE; scripts/setup/yade.sh has YADE's project() include it.
# Most of that build reads the same headers again and again, and compiles code that runs once, when a module is
# loaded. So the headers of others are read once, into a precompiled header, and the modules that only make
# classes known to Python are compiled with less optimisation. What a step runs keeps its options: its cost and its
# bits are those of YADE's own build. Warnings on code that is not ours are not asked for.

function(nonsmooth_shorten_yade)
  # _math sets macros before it reads the headers, and _minieigenHP reads them in a way of its own
  set(stepping yade pkg_common pkg_dem)
  set(others boot pre_dem post_vtk wrapper _customConverters _libVersions _log _utils _packPredicates _packSpheres _packObb
      _ymport WeightedAverage2d _polyhedra_utils)
  set(headers <lib/base/Math.hpp> <lib/base/Logging.hpp> <lib/base/AliasNamespaces.hpp> <lib/high-precision/Constants.hpp>
      <lib/pyutil/doc_opts.hpp> <lib/serialization/Serializable.hpp> <boost/python.hpp> <boost/algorithm/string.hpp>
      <boost/lexical_cast.hpp> <Eigen/Dense> <functional> <fstream> <thread>)
  target_precompile_headers(yade PRIVATE ${headers})
  foreach(target IN LISTS stepping others)
    if(TARGET ${target} AND NOT target STREQUAL "yade")
      target_precompile_headers(${target} REUSE_FROM yade)
    endif()
  endforeach()
  foreach(target IN LISTS stepping others)
    if(TARGET ${target})
      target_compile_options(${target} PRIVATE -Wno-all $<$<IN_LIST:${target},${others}>:-O1>)
    endif()
  endforeach()
endfunction()

cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL nonsmooth_shorten_yade)
