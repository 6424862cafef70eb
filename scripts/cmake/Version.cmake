# <ridgemap/version.h>, from the version in project(); every target that links the core finds it.
configure_file(${PROJECT_SOURCE_DIR}/scripts/cmake/version.h.in ${PROJECT_BINARY_DIR}/include/ridgemap/version.h @ONLY)
target_include_directories(ridgemap-core PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
