# umbrage_module(NAME name
#                [SOURCES a.cpp ..] [HEADERS a.hpp ..] [TESTS a_test.cpp ..] [SHADERS a.vert ..]
#                [DEPENDS other-room ..]          rooms, by name; public
#                [LIBS foreign ..] [PUBLIC_LIBS foreign ..])
#
# One room of the house: the static library umbrage::<name> (umbrage_<name>), its public headers as an installed file set,
# and its tests as one GoogleTest program. A room may depend only on rooms that exist already, so circles cannot be written.

add_library(umbrage_flags INTERFACE)
# No contraction: the silhouette predicates must give the same bits on the CPU, in tests and in every build.
target_compile_options(umbrage_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers)
# GCC 12 sees overlapping copies in std::string's own operator+ (GCC bug 105329).
target_compile_options(umbrage_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# GCC 12 drops the rounding in double(float(x)) where it turns neighbouring statements into vector instructions: what a
# float leaves of a double came out as 0 (math_test, Rounding).
target_compile_options(umbrage_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
if(UMBRAGE_WARNINGS_AS_ERRORS)
  target_compile_options(umbrage_flags INTERFACE -Werror)
endif()
if(UMBRAGE_SANITIZE)
  target_compile_options(umbrage_flags INTERFACE -fsanitize=${UMBRAGE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(umbrage_flags INTERFACE -fsanitize=${UMBRAGE_SANITIZE})
endif()
if(UMBRAGE_COVERAGE)
  target_compile_options(umbrage_flags INTERFACE --coverage)
  target_link_options(umbrage_flags INTERFACE --coverage)
endif()

# Rooms in the order of their making, from the ground up; per room its folder, public headers, rooms and foreign libraries:
# what installing (UmbrageInstall.cmake) and the layering test go by.
set_property(GLOBAL PROPERTY UMBRAGE_ROOMS "")

# Sets `result` to whether the imported target `library` has nothing to link.
function(umbrage_is_header_only library result)
  set(${result} FALSE PARENT_SCOPE)
  if(TARGET ${library})
    get_target_property(type ${library} TYPE)
    get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
    if(type STREQUAL "INTERFACE_LIBRARY" AND NOT links)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

function(umbrage_module)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;HEADERS;TESTS;SHADERS;DEPENDS;LIBS;PUBLIC_LIBS;TEST_LIBS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "umbrage_module(${ARG_NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(target umbrage_${ARG_NAME})
  set(foreign "")
  if(ARG_SOURCES OR ARG_SHADERS)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:umbrage_flags>)
    foreach(library IN LISTS ARG_LIBS)
      # What is header-only and used in sources alone is no business of those who link the installed room.
      umbrage_is_header_only(${library} header_only)
      if(header_only)
        target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${library}>)
      else()
        target_link_libraries(${target} PRIVATE ${library})
        list(APPEND foreign ${library})
      endif()
    endforeach()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(umbrage::${ARG_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME} VERIFY_INTERFACE_HEADER_SETS ${UMBRAGE_BUILD_TESTS})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${ARG_HEADERS})
  foreach(dependency IN LISTS ARG_DEPENDS)
    if(NOT TARGET umbrage_${dependency})
      message(FATAL_ERROR "umbrage_module(${ARG_NAME}): the room '${dependency}' does not exist (yet). "
                          "Rooms are listed from the ground up in src/umbrage/CMakeLists.txt; a circle is refused here.")
    endif()
    target_link_libraries(${target} ${scope} umbrage_${dependency})
  endforeach()
  if(ARG_PUBLIC_LIBS)
    target_link_libraries(${target} ${scope} ${ARG_PUBLIC_LIBS})
  endif()
  if(ARG_SHADERS)
    umbrage_embed_shaders(${target} ${ARG_SHADERS})
  endif()
  set_property(GLOBAL APPEND PROPERTY UMBRAGE_ROOMS ${ARG_NAME})
  set_property(GLOBAL PROPERTY UMBRAGE_${ARG_NAME}_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_property(GLOBAL PROPERTY UMBRAGE_${ARG_NAME}_DEPENDS ${ARG_DEPENDS})
  set_property(GLOBAL PROPERTY UMBRAGE_${ARG_NAME}_HEADERS ${ARG_HEADERS})
  set_property(GLOBAL PROPERTY UMBRAGE_${ARG_NAME}_TEST_LIBS ${ARG_TEST_LIBS})
  set_property(GLOBAL PROPERTY UMBRAGE_${ARG_NAME}_FOREIGN ${foreign} ${ARG_PUBLIC_LIBS})
  if(UMBRAGE_BUILD_TESTS AND ARG_TESTS)
    umbrage_test(NAME ${target}_test SOURCES ${ARG_TESTS} LIBS ${target} ${ARG_TEST_LIBS})
  endif()
endfunction()

# umbrage_test(NAME program SOURCES .. LIBS .. [LABELS ..] [TIMEOUT seconds]): one GoogleTest program, each case a CTest case.
function(umbrage_test)
  cmake_parse_arguments(ARG "" "NAME;TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE umbrage_flags ${ARG_LIBS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${ARG_NAME} PRIVATE UMBRAGE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                             UMBRAGE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  target_include_directories(${ARG_NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  if(UMBRAGE_SANITIZE)
    target_sources(${ARG_NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/sanitizer_suppressions.cpp)
  endif()
  gtest_discover_tests(${ARG_NAME} DISCOVERY_MODE PRE_TEST WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                       PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}")
endfunction()

# Texts that a program carries (shaders, style sheets, rules) are real files; each is embedded as `inline constexpr std::string_view
# umbrage::<kind>::k<NameExtension>` in <umbrage_<kind>/name_extension.hpp>: umbrage_embed(target shaders zfail_volume.vert) makes
# <umbrage_shaders/zfail_volume_vert.hpp> and umbrage::shaders::kZfailVolumeVert.
function(umbrage_embed target kind)
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  foreach(path IN LISTS ARGN)
    get_filename_component(file ${path} NAME)
    string(REPLACE "." "_" stem ${file})
    set(output ${directory}/umbrage_${kind}/${stem}.hpp)
    add_custom_command(OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${CMAKE_CURRENT_SOURCE_DIR}/${path} -DOUTPUT=${output} -DSTEM=${stem} -DKIND=${kind}
              -P ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${path} ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
      COMMENT "Embedding ${path}" VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endforeach()
  target_include_directories(${target} PRIVATE ${directory})
endfunction()

# Shaders are also checked by glslangValidator in the tests where that program exists.
function(umbrage_embed_shaders target)
  umbrage_embed(${target} shaders ${ARGN})
  if(UMBRAGE_BUILD_TESTS)
    find_program(UMBRAGE_GLSLANG glslangValidator)
    if(UMBRAGE_GLSLANG)
      foreach(shader IN LISTS ARGN)
        get_filename_component(file ${shader} NAME)
        add_test(NAME shader.${file} COMMAND ${UMBRAGE_GLSLANG} ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
      endforeach()
    endif()
  endif()
endfunction()
