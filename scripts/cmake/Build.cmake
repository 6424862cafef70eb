# How the project is compiled and where its outputs go.

get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT CMAKE_BUILD_TYPE AND NOT is_multi_config AND PROJECT_IS_TOP_LEVEL)
	set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

# Installed programs find the plug-in library from any prefix, also after the prefix was moved.
file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set(CMAKE_INSTALL_RPATH "$ORIGIN/${bin_to_lib}")

if(RIDGEMAP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
	find_program(RIDGEMAP_CCACHE_PROGRAM ccache)
	mark_as_advanced(RIDGEMAP_CCACHE_PROGRAM)
	if(RIDGEMAP_CCACHE_PROGRAM)
		set(CMAKE_CXX_COMPILER_LAUNCHER ${RIDGEMAP_CCACHE_PROGRAM})
	endif()
endif()

# What every target of the project is compiled with. Contraction of a*b+c would make results depend on the machine.
add_library(ridgemap_compile_options INTERFACE)
target_compile_features(ridgemap_compile_options INTERFACE cxx_std_17)
target_compile_options(ridgemap_compile_options INTERFACE -Wall -Wextra -Wshadow -ffp-contract=off
	$<$<BOOL:${RIDGEMAP_WERROR}>:-Werror>)
