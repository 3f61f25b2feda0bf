# Options of all targets (warnings, sanitizers), and functions that declare a folder of sources with its tests and a
# library that is loaded at run time.

find_package(Threads REQUIRED)

add_library(imgeo_options INTERFACE)
target_compile_options(imgeo_options INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor)
# clang reports what libstdc++ 12 calls in std::stable_sort.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(imgeo_options INTERFACE -Wno-deprecated-declarations)
endif()
# A new enumerator (a vertex role, an encoding) must not compile until every switch handles it.
target_compile_options(imgeo_options INTERFACE -Werror=switch)
target_include_directories(imgeo_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
# Encoded bytes must not depend on the machine: the compiler must not fuse multiply and add.
target_compile_options(imgeo_options INTERFACE -ffp-contract=off)
if(IMGEO_SANITIZE)
  target_compile_options(imgeo_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(imgeo_options INTERFACE -fsanitize=address,undefined)
  if(NOT IMGEO_LIBFUZZER)
    # A third of the compile time. AddressSanitizer stops at bad pointers as well; preset fuzz has these checks.
    target_compile_options(imgeo_options INTERFACE
      -fno-sanitize=null,object-size,vptr,alignment,nonnull-attribute,returns-nonnull-attribute)
  endif()
endif()
if(IMGEO_LIBFUZZER)
  target_compile_options(imgeo_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(IMGEO_THREAD_SANITIZE)
  target_compile_options(imgeo_options INTERFACE -fsanitize=thread)
  target_link_options(imgeo_options INTERFACE -fsanitize=thread)
endif()

# GCC collects garbage whenever its heap has grown by some 100 MB, which takes a sixth of the time of a unity build.
# Where each core has memory for it, it may use up to a gigabyte first.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  cmake_host_system_information(RESULT memory_mib QUERY TOTAL_PHYSICAL_MEMORY)
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  math(EXPR heap_kib "${memory_mib} * 1024 / (4 * ${cores})")
  if(heap_kib GREATER 1048576)
    set(heap_kib 1048576)
  endif()
  if(heap_kib GREATER 131072)
    target_compile_options(imgeo_options INTERFACE
      "$<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=${heap_kib};--param=ggc-min-expand=200>")
  endif()
endif()

# Where processor time goes in conversion; other folders compile in 0.85 of the time with -O2 (CMakePresets.json).
set(IMGEO_HOT_FOLDERS prepare containers images live)

# Tests run once per build: the tested code is optimised, test code compiles in half of the time without.
set(IMGEO_TEST_OPTIONS $<$<CONFIG:Release>:$<IF:$<CXX_COMPILER_ID:GNU>,-Og,-O0>>)

# Both link a program of tests in half of GNU ld's time. With clang's sanitizers gold prints a thousand warnings.
find_program(IMGEO_GOLD ld.gold)
find_program(IMGEO_LLD ld.lld-19)
set(IMGEO_TEST_LINK_OPTIONS)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND IMGEO_LLD)
  set(IMGEO_TEST_LINK_OPTIONS -fuse-ld=lld)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND IMGEO_GOLD)
  set(IMGEO_TEST_LINK_OPTIONS -fuse-ld=gold)
endif()

# imgeo_folder(NAME USES targets... TEST_USES targets...): makes the library imgeo_NAME of the .cpp files of this
# folder and its subfolders, and the test program NAME_test of the *_test.cpp files.
function(imgeo_folder name)
  cmake_parse_arguments(ARG "" "" "USES;TEST_USES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|/main\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  if(sources)
    add_library(imgeo_${name} STATIC ${sources})
    target_link_libraries(imgeo_${name} PUBLIC imgeo_options ${ARG_USES})
    if(name IN_LIST IMGEO_HOT_FOLDERS)
      target_compile_options(imgeo_${name} PRIVATE $<$<CONFIG:Release>:-O3>)
    endif()
  else()
    add_library(imgeo_${name} INTERFACE)
    target_link_libraries(imgeo_${name} INTERFACE imgeo_options ${ARG_USES})
  endif()
  if(tests AND BUILD_TESTING)
    find_package(GTest REQUIRED)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE imgeo_${name} ${ARG_TEST_USES} GTest::gtest GTest::gtest_main)
    target_compile_options(${name}_test PRIVATE ${IMGEO_TEST_OPTIONS})
    target_link_options(${name}_test PRIVATE ${IMGEO_TEST_LINK_OPTIONS})
    add_test(NAME ${name} COMMAND ${name}_test --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "IMGEO_SHARED=${PROJECT_SOURCE_DIR}/../shared")
  endif()
endfunction()

# imgeo_dynamic_library(FOLDER MACRO PREFIX): lets sources of imgeo_FOLDER include the headers of a library that
# pkg_check_modules found as PREFIX, and load it at run time by the name in MACRO (src/base/dynamic_library.h).
function(imgeo_dynamic_library folder macro prefix)
  list(GET ${prefix}_LINK_LIBRARIES 0 library)
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${library} OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
  if(NOT headers MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${library} is not a shared library")
  endif()
  target_compile_definitions(imgeo_${folder} PRIVATE ${macro}="${CMAKE_MATCH_1}")
  target_include_directories(imgeo_${folder} SYSTEM PUBLIC ${${prefix}_INCLUDE_DIRS})
endfunction()
