#include "cli/site_flags.h"

#include "cli/common_flags.h"

namespace imgeo::cli {

namespace {

Flag meshFileFlag() {
  return {.name = "output",
          .aliases = {"-o"},
          .valueKind = ValueKind::file,
          .valueName = "FILE",
          .help = "the file to write; .ply, .obj or .glb says what",
          .required = true};
}

} // namespace

Command infoCommand() {
  return {.name = "info",
          .usage = "PATH [--json]",
          .summary = "say what a site or a mesh file holds, and where its bytes are",
          .text = "PATH is a site's directory, its index.html or scene.x3d, a file of vertex data, or a mesh to "
                  "convert.",
          .flags = {positionalFlag("path", "PATH", ValueKind::file, "a site or a file"), outsideFlag(), jsonFlag("it"),
                    helpFlag()},
          .examples = {"imgeo info site", "imgeo info site --json | jq .documentBytes", "imgeo info statue.ply"}};
}

Command verifyCommand() {
  Flag input = positionalFlag("input", "INPUT", ValueKind::file,
                              "the file it was converted from; for a sequence the files of all frames, or a pattern in "
                              "quotes");
  input.repeatable = true;
  return {
      .name = "verify",
      .usage = "DIR INPUT... [--memory SIZE] [--work FOLDER] [--json]",
      .summary = "read a site back and prove that it equals its input",
      .text = "Compares every triangle, line or point of the site with the input, welded as convert does it: the "
              "same elements in the same orientation, positions within half a step of the lattice, normals within "
              "the rounding of their bits. Checks that every file is there and holds what its name says, and its "
              "pictures what imgeo.json says; in a site of another program only that it is there. Geometry that stays "
              "in nodes of the document (Box, small IndexedFaceSets) is compared field by field with X3D, and as "
              "meshes with any other input. With a GLB that export wrote, animations are compared as glTF has "
              "them, and one line says what of them glTF cannot express. A mesh or a cloud with levels of detail that "
              "memory does not hold is compared out of core, region by region, with the files that convert reads so. "
              "Exits with 0 only if all of that is so, with 3 if not.",
      .flags = {positionalFlag("site", "DIR", ValueKind::directory, "the site"),
                input,
                {.name = "memory",
                 .valueKind = ValueKind::text,
                 .valueName = "SIZE",
                 .help = "the memory to use, as 1G or 800M, at least 256M; meshes and clouds with levels of detail "
                         "that take more are compared out of core, if convert reads their source so; otherwise three "
                         "quarters of the machine's"},
                {.name = "work",
                 .valueKind = ValueKind::text,
                 .valueName = "FOLDER",
                 .help = "compare out of core, with intermediate files in this folder, which are removed; "
                         "otherwise, and where it has to be, in .DIR.imgeo-verify beside DIR"},
                outsideFlag(),
                jsonFlag("the result"),
                helpFlag()},
      .examples = {"imgeo verify site statue.ply", "imgeo verify cloth frame-*.ply",
                   "imgeo verify site scan.ply --memory 1G",
                   "imgeo verify site statue.ply --json | jq .normalErrorDegrees"}};
}

Command exportCommand() {
  return {.name = "export",
          .usage = "DIR -o FILE [--frame N|all]",
          .summary = "write the mesh that a site holds as PLY, OBJ or GLB",
          .text = "Reads a site back, joins the patches of each mesh and writes all shapes into one file. "
                  "Geometry that stays in nodes of the document (Box, small IndexedFaceSets) is written as meshes; "
                  "Text is left out, with a warning. Reads sites that aopt wrote for X3DOM, too.",
          .flags = {positionalFlag("site", "DIR", ValueKind::directory, "the site, its index.html or a .x3d file"),
                    meshFileFlag(),
                    textFlag("frame", "N|all", "of a sequence: this frame, from 0; all: FILE-0000, FILE-0001 ..."),
                    integerFlag("level", {}, 0, 31, "0",
                                "of meshes with levels of detail: 0, the whole mesh, or a coarser one"),
                    jsonFlag("what was written"), helpFlag()},
          .examples = {"imgeo export site -o statue.ply", "imgeo export old/statue.x3d -o statue.glb",
                       "imgeo export cloth -o frames/cloth.ply --frame all"}};
}

Command transformCommand() {
  return {
      .name = "transform",
      .usage = "INPUT -o FILE --operators LIST",
      .summary = "map the vertices of a mesh by image operators",
      .text = "Writes the mesh that a page shows whose geometry nodes have the field operators=\"LIST\". The "
              "operators are translate, scale, gamma, negate, swizzle, solarize, threshold, posterise and, for "
              "sites of profile classic, blur; docs/formats/nodes.md has their arguments. They map each coordinate "
              "as a part, 0 to 1, of the cube over the longest edge of the mesh's box.",
      .flags = {positionalFlag("input", "INPUT", ValueKind::file,
                               "a site's directory or a mesh file of any format that convert reads; \"-\" reads "
                               "standard input"),
                meshFileFlag(),
                {.name = "operators",
                 .valueKind = ValueKind::text,
                 .valueName = "LIST",
                 .help = "operators in their order, such as \"scale(0.8) negate(x)\"; after those of a site's nodes",
                 .required = true},
                outsideFlag(),
                jsonFlag("what was written"),
                helpFlag()},
      .examples = {"imgeo transform statue.ply -o mirrored.ply --operators \"negate(x)\"",
                   "imgeo transform site -o statue.glb --operators \"gamma(1.2) scale(0.8 1 0.8)\""}};
}

} // namespace imgeo::cli
