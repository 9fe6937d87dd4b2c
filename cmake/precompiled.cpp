// The headers that cmake/PasBuild.cmake lists are compiled once, with this file.
