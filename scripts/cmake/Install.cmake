# Install rules and the package that find_package(ridgemap) reads: components core and mrpt, each with its own export,
# so that the core can be used on a machine without MRPT.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ridgemap)

foreach(component core mrpt)
	set(library ridgemap-${component})
	if(NOT TARGET ${library})
		continue()
	endif()
	install(TARGETS ${library} EXPORT ${library}-targets
		ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
		LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
		INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
	install(DIRECTORY ${PROJECT_SOURCE_DIR}/libs/${library}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
	install(EXPORT ${library}-targets NAMESPACE ridgemap:: DESTINATION ${package_dir})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/include/ridgemap/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ridgemap)

# Every program under apps/ is installed.
function(ridgemap_install_programs directory)
	get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
	foreach(target IN LISTS targets)
		get_target_property(type ${target} TYPE)
		if(type STREQUAL EXECUTABLE)
			install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
		endif()
	endforeach()
	get_property(children DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
	foreach(child IN LISTS children)
		ridgemap_install_programs(${child})
	endforeach()
endfunction()
if(RIDGEMAP_BUILD_MRPT)
	ridgemap_install_programs(${PROJECT_SOURCE_DIR}/apps)
endif()

# The MRPT packages that users of the plug-in library must find: those it links publicly.
set(mrpt_packages "")
if(TARGET ridgemap-mrpt)
	get_target_property(links ridgemap-mrpt INTERFACE_LINK_LIBRARIES)
	list(FILTER links INCLUDE REGEX "^mrpt::")
	list(TRANSFORM links REPLACE "^mrpt::" "mrpt-" OUTPUT_VARIABLE mrpt_packages)
	list(JOIN mrpt_packages " " mrpt_packages)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/scripts/cmake/ridgemap-config.cmake.in
	${PROJECT_BINARY_DIR}/cmake/ridgemap-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/ridgemap-config-version.cmake
	COMPATIBILITY SameMinorVersion)
install(FILES
	${PROJECT_BINARY_DIR}/cmake/ridgemap-config.cmake
	${PROJECT_BINARY_DIR}/cmake/ridgemap-config-version.cmake
	DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
	DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgemap)
