# The library is static: whoever links it links what it stands on.
include(CMakeFindDependencyMacro)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(Threads)
find_dependency(fmt)
find_dependency(jsoncpp)
find_dependency(ZLIB)
include(${CMAKE_CURRENT_LIST_DIR}/sessileTargets.cmake)
