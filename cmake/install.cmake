# What `make install` installs: the tool with its manual page and shell completions, and the C++ library imgeo::imgeo
# with its headers and a CMake package. Included by src/CMakeLists.txt after all folders.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# libimgeo.a holds the objects of all folders but the tool's own.
set(library_objects)
foreach(folder base motions content markup images scene import prepare containers live sequence video documents export transcode)
  list(APPEND library_objects $<TARGET_OBJECTS:imgeo_${folder}>)
endforeach()
add_library(imgeo_library STATIC ${library_objects})
set_target_properties(imgeo_library PROPERTIES OUTPUT_NAME imgeo EXPORT_NAME imgeo LINKER_LANGUAGE CXX)
target_compile_features(imgeo_library PUBLIC cxx_std_20)
target_include_directories(imgeo_library INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# The same packages as in cmake/imgeoConfig.cmake.in.
find_package(meshoptimizer REQUIRED)
find_package(pugixml REQUIRED)
pkg_check_modules(BROTLI REQUIRED IMPORTED_TARGET libbrotlienc)
pkg_check_modules(GUMBO REQUIRED IMPORTED_TARGET gumbo)
pkg_check_modules(VPX REQUIRED IMPORTED_TARGET vpx)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
find_library(DRACO_ARCHIVE libdraco.a REQUIRED)
target_link_libraries(imgeo_library PRIVATE fmt::fmt TBB::tbb meshoptimizer::meshoptimizer pugixml::pugixml
  PkgConfig::BROTLI PkgConfig::DEFLATE PkgConfig::GUMBO PkgConfig::VPX PkgConfig::WEBP PkgConfig::XXHASH ${DRACO_ARCHIVE}
  Threads::Threads ${CMAKE_DL_LIBS})

# libimgeo-live.a adds the publishing of live streams to it (imgeo/live.h), with an HTTP server.
add_library(imgeo_live_library STATIC $<TARGET_OBJECTS:imgeo_serve> $<TARGET_OBJECTS:imgeo_publish>)
set_target_properties(imgeo_live_library PROPERTIES OUTPUT_NAME imgeo-live EXPORT_NAME live LINKER_LANGUAGE CXX)
target_link_libraries(imgeo_live_library PUBLIC imgeo_library)

# libimgeo-live.so has all that C programs and other languages need (imgeo/live_c.h), and shows nothing else.
set(live_exports ${PROJECT_SOURCE_DIR}/cmake/live_exports.map)
add_library(imgeo_live_shared SHARED $<TARGET_OBJECTS:imgeo_publish>)
set_target_properties(imgeo_live_shared PROPERTIES OUTPUT_NAME imgeo-live EXPORT_NAME live_c LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} LINK_DEPENDS ${live_exports})
target_link_libraries(imgeo_live_shared PRIVATE imgeo_serve imgeo_live imgeo_content imgeo_base)
target_link_options(imgeo_live_shared PRIVATE "-Wl,--version-script,${live_exports}" -Wl,--gc-sections)
target_include_directories(imgeo_live_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

install(TARGETS imgeo)
install(TARGETS imgeo_library imgeo_live_library imgeo_live_shared EXPORT imgeoTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/imgeo DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/imgeo)
install(EXPORT imgeoTargets NAMESPACE imgeo:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/imgeoConfig.cmake.in ${PROJECT_BINARY_DIR}/imgeoConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/imgeoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/imgeoConfig.cmake ${PROJECT_BINARY_DIR}/imgeoConfigVersion.cmake
  DESTINATION ${package_folder})

# install_output(FILE ARGUMENTS...): installs the output of `imgeo ARGUMENTS...` as FILE.
function(install_output file)
  install(CODE "
    set(file \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${file}\")
    message(STATUS \"Installing: \${file}\")
    get_filename_component(folder \"\${file}\" DIRECTORY)
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"$<TARGET_FILE:imgeo>\" ${ARGN} OUTPUT_FILE \"\${file}\" COMMAND_ERROR_IS_FATAL ANY)")
endfunction()
install_output(${CMAKE_INSTALL_MANDIR}/man1/imgeo.1 manual)
install_output(${CMAKE_INSTALL_DATADIR}/bash-completion/completions/imgeo completion bash)
install_output(${CMAKE_INSTALL_DATADIR}/zsh/site-functions/_imgeo completion zsh)
install_output(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/imgeo.fish completion fish)
