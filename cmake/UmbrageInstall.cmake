# Installs every room with its public headers, each as a component of find_package(umbrage COMPONENTS render ...).
# A room is an export set of its own, so that a consumer looks for the foreign libraries of the rooms it names and no others.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/umbrage)
get_property(rooms GLOBAL PROPERTY UMBRAGE_ROOMS)
set(UMBRAGE_ROOM_TABLE "")
foreach(room IN LISTS rooms)
  install(TARGETS umbrage_${room} EXPORT umbrage_${room}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT umbrage_${room} FILE umbrage-${room}.cmake NAMESPACE umbrage:: DESTINATION ${package_dir})
  get_property(depends GLOBAL PROPERTY UMBRAGE_${room}_DEPENDS)
  get_property(foreign GLOBAL PROPERTY UMBRAGE_${room}_FOREIGN)
  string(APPEND UMBRAGE_ROOM_TABLE "set(_umbrage_${room}_depends ${depends})\nset(_umbrage_${room}_foreign ${foreign})\n")
endforeach()
list(JOIN rooms " " UMBRAGE_ROOMS)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/umbrage-config.cmake.in
                              ${PROJECT_BINARY_DIR}/cmake/umbrage-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/umbrage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/umbrage-config.cmake ${PROJECT_BINARY_DIR}/cmake/umbrage-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/UmbrageForeign.cmake DESTINATION ${package_dir})
