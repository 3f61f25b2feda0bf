#include "cli/convert_flags.h"

#include "cli/choices.h"
#include "cli/common_flags.h"
#include "containers/encodings.h"
#include "import/format.h"

#include <algorithm>

namespace imgeo::cli {

namespace {

/// `values`, then the different values that a member has in the rows of the encodings.
std::vector<std::string> valuesOf(const char* EncodingRow::*member, std::vector<std::string> values = {}) {
  for (const EncodingRow* row : allEncodings())
    if (std::ranges::find(values, row->*member) == values.end())
      values.emplace_back(row->*member);
  return values;
}

} // namespace

Command convertCommand() {
  Flag input = positionalFlag("input", "INPUT", ValueKind::file,
                              formatHelp() + " file, gzipped or not; \"-\" reads standard input");
  input.aliases = {"-i"};
  input.repeatable = true;
  input.help += "; several files, or a pattern in quotes, are the frames of a sequence, in the order of their numbers";
  Flag output{.name = "output",
              .aliases = {"-o"},
              .valueKind = ValueKind::directory,
              .valueName = "DIR",
              .help = "the site's directory; an older site there is replaced in one step",
              .required = true};
  Flag report{.name = "report",
              .aliases = {"-r"},
              .valueKind = ValueKind::file,
              .valueName = "FILE",
              .help = "write a report of what was chosen and measured, as JSON"};
  return {
      .name = "convert",
      .usage = "INPUT... -o DIR [options]",
      .summary = "turn a mesh into a page that shows it progressively",
      .text = "Writes a static site: index.html, the scene as X3D, the runtime, and the mesh's vertex data in files "
              "named by their content. The directory takes its place in one step; killed at any moment, it is the old "
              "site or the new one.",
      .flags =
          {input,
           output,
           choiceFlag("up", namesOf(upChoices),
                      "the source's axis that points up; auto: what the format says, and for OBJ, PLY, STL and others "
                      "that do not say it a guess by the shape, which is printed with its reason"),
           {.name = "rotate",
            .valueKind = ValueKind::text,
            .valueName = "AXIS:DEGREES,...",
            .help = "then turn the source: y:90 about the upward axis, x:-30,y:90 about x first"},
           {.name = "scale",
            .valueKind = ValueKind::text,
            .valueName = "FACTOR",
            .help = "then multiply its lengths",
            .defaultValue = "1"},
           {.name = "exaggerate",
            .valueKind = ValueKind::text,
            .valueName = "FACTOR",
            .help = "then multiply its heights, as maps of terrain do",
            .defaultValue = "1"},
           {.name = "rate",
            .valueKind = ValueKind::text,
            .valueName = "FRAMES",
            .help = "sequences: frames per second",
            .defaultValue = "30"},
           choiceFlag("unit", namesOf(unitChoices),
                      "the unit of the source's numbers, which become metres; auto: what the file says, otherwise m"),
           choiceFlag("view", namesOf(viewChoices),
                      "the side that is shown first; auto: the source's viewpoint, otherwise the three-quarter view "
                      "that shows the most of the surface"),
           choiceFlag("container", valuesOf(&EncodingRow::container), "sig: PNG images; bg: typed arrays"),
           choiceFlag("profile", valuesOf(&EncodingRow::profile, {"auto"}),
                      "of sig. compact: a coarse shape first, then patches, decoded by workers; classic: three "
                      "times its bytes, refined byte by byte, decoded by the GPU, and by X3DOM 1.7 as well; "
                      "auto: compact, but classic with --primitives strips, --index off, --normals palette or "
                      "spherical, more than 30 position bits, 1048576 patch vertices or 13 attributes to keep"),
           choiceFlag("as", namesOf(formChoices),
                      "geometry-image: sample surfaces anew on regular grids, one for each chart, without an index; "
                      "height-map: a regular grid of heights as images of them; both in profile classic; "
                      "sequence: animated joints, morph targets and coordinates as recorded frames, "
                      "--rate a second; "
                      "video: frames of a sequence as a lossless video, too"),
           integerFlag("grid", {}, 4, maxGridEdge, "",
                       "geometry images: N * N texels for a mesh, 4..4096, otherwise 256"),
           choiceFlag("target", namesOf(targetChoices),
                      "web: a page with its own runtime; x3dom: one for X3DOM 1.7.2 (sig) or 1.8.3 (bg)"),
           {.name = "x3dom-url",
            .valueKind = ValueKind::text,
            .valueName = "URL",
            .help = "target x3dom: the folder that has x3dom.js and x3dom.css; otherwise npm's by "
                    "jsdelivr.net"},
           choiceFlag("primitives", namesOf(primitivesChoices),
                      "how patches are drawn, those of lines as lines, line strips or points; a point cloud "
                      "is always points"),
           choiceFlag("index", namesOf(indexChoices),
                      "off: vertices are repeated wherever they are drawn instead of named by an index"),
           integerFlag("position-bits", {"-vp", "-qp"}, 8, 32, "",
                       "bits of a coordinate, 8..32, in compact 8..30, on one lattice over the whole mesh; "
                       "otherwise 16, or what the coordinates' type holds; compact takes fewer for a mesh whose "
                       "coordinates lie on a coarser lattice already, and keeps them"),
           {.name = "max-error",
            .valueKind = ValueKind::text,
            .valueName = "LENGTH|PERCENT",
            .help = "sig: the fewest position bits that move no vertex farther, in units of the source or, "
                    "with %, of a mesh's longest edge; geometry images: the smallest grid whose surface is no "
                    "farther off"},
           choiceFlag("coord-type", namesOf(coordTypeChoices),
                      "bg: elements of coordinates; auto: the fewest unsigned bytes; float32 without "
                      "--position-bits: the source's numbers"),
           choiceFlag("layout", namesOf(layoutChoices),
                      "bg: a file for each attribute, or one of records with all of them beside the index"),
           choiceFlag("normals", namesOf(normalsChoices),
                      "how normals are stored: as vectors, as two numbers (compact: always), as 256 directions "
                      "a patch, or in compact not at all"),
           choiceFlag("images", namesOf(imagesChoices),
                      "file format of classic's images, both lossless; webp: WebP where it is smaller than PNG, a few "
                      "percent fewer bytes for ten times the encoding time"),
           integerFlag("normal-bits", {"-vn", "-qn"}, 4, 32, "",
                       "bits of a normal's component; classic: 8 or 16, compact: 4..16; bg: 8, 16 or 32; otherwise 8"),
           integerFlag("texcoord-bits", {"-vt", "-qt"}, 1, 32, "",
                       "bits of a texture coordinate; compact: 1..16, otherwise 12; classic: 8, 16 or 24, bg: 8, 16 "
                       "or 32, otherwise 16"),
           integerFlag("color-bits", {"-vc"}, 1, 32, "",
                       "bits of a colour's component; compact: 1..8; classic: 8, 16 or 24, bg: 8, 16 or 32; "
                       "otherwise 8, which is what imgeo reads of sources"),
           integerFlag("patch-vertices", {}, 256, 4194304, "65535",
                       "the most vertices in one patch, 256..4194304; more than 65535 take 32-bit indices"),
           {.name = "base",
            .valueKind = ValueKind::text,
            .valueName = "PERCENT",
            .help = "compact: a first shape of so many of the triangles in 100, 0..25; 0: none, otherwise 2"},
           choiceFlag("instances", namesOf(instancesChoices),
                      "auto: a mesh that is another one, moved or turned, is stored once, and shapes of it become "
                      "instances; never: only what the source instances"),
           choiceFlag("levels", namesOf(levelsChoices),
                      "compact: levels of detail, of which pages load what a view needs; auto: of meshes of more than "
                      "2,000,000 triangles, or points"),
           integerFlag("group-triangles", {}, 256, 262144, "32768",
                       "levels: the most triangles, or points, in one file, 256..262144"),
           integerFlag("region-triangles", {}, 4096, 4194304, "1048576",
                       "levels: about how many triangles, or points, are cut into files at a time, 4096..4194304"),
           {.name = "memory",
            .valueKind = ValueKind::text,
            .valueName = "SIZE",
            .help =
                "levels: the memory to use, as 1G or 800M; sources in PLY, binary STL, OBJ, GLB, LAS, E57, PTS and XYZ "
                "that take more are converted out of core, region by region; otherwise three quarters of the "
                "machine's"},
           {.name = "work",
            .valueKind = ValueKind::text,
            .valueName = "FOLDER",
            .help =
                "convert out of core, with intermediate files in this folder; otherwise, and where it has to be, in "
                ".DIR.imgeo-work beside DIR"},
           {.name = "resume", .help = "out of core: go on where an earlier run of the same command ended"},
           integerFlag(
               "ranks", {}, 1, 65536, "1",
               "out of core: how many processes with the same options share the work folder and the work, on one "
               "machine or many"),
           integerFlag("rank", {}, 0, 65535, "0", "the number of this process among them; 0 writes the site"),
           integerFlag("silence", {}, 1, 604800, "120",
                       "ranks: seconds without a sign of life of another rank after which this one ends"),
           choiceFlag("drop", namesOf(dropChoices),
                      "which elements to leave out: those with two corners at one place, those that repeat "
                      "another, or both"),
           {.name = "keep-attributes",
            .valueKind = ValueKind::text,
            .valueName = "NAMES",
            .help = "further numbers of vertices and points to keep: names with commas between, all or none",
            .defaultValue = "none"},
           integerFlag("attribute-bits", {}, 8, 24, "",
                       "bits of such a number; sig: 8, 16 or 24, otherwise 16; bg holds floats"),
           choiceFlag("textures", namesOf(texturesChoices),
                      "what images of textures are written as; keep: as they are, and those that no browser "
                      "shows (TGA, TIFF, BMP ...) as lossless WebP. Normal maps and other data are never lossy"),
           integerFlag("texture-size", {}, 1, 16383, "",
                       "the longest edge of a texture in pixels; larger ones are made smaller, none larger"),
           integerFlag("texture-quality", {}, 0, 100, "", "of lossy textures; otherwise 80 of webp, 60 of avif"),
           integerFlag("texture-preview", {}, 0, 256, "64",
                       "the longest edge of what is shown first of a large texture; 0: nothing is"),
           choiceFlag("normal-weighting", namesOf(normalWeightingChoices),
                      "how triangles count in normals that the source lacks"),
           {.name = "crease-angle",
            .valueKind = ValueKind::text,
            .valueName = "DEGREES",
            .help = "of normals that the source lacks: edges at which triangles meet at a larger angle are sharp, "
                    "0: all, 180: none; otherwise 0 in glTF, 39 in formats of man-made objects (IFC, Collada, "
                    "FBX ...), and a guess by the shape in PLY, OBJ, STL and OFF: 39 or 180"},
           {.name = "title",
            .valueKind = ValueKind::text,
            .valueName = "TEXT",
            .help = "the page's title; otherwise the input's name"},
           {.name = "no-pictures",
            .help = "leave out icon.png and picture.png, the pictures of tabs and of previews of links"},
           integerFlag("effort", {}, 0, 9, "5",
                       "how hard to compress: 0 fastest, 9 smallest; in compact 1 to 6 are one"),
           integerFlag("threads", {}, 0, 1024, "0",
                       "how many threads to use; 0: all. The site is the same with any number"),
           {.name = "precompress",
            .help = "write FILE.br and FILE.gz beside text and BG's arrays, for hosts that do not compress"},
           outsideFlag(),
           {.name = "strict", .help = "refuse a source of which a part is damaged, instead of leaving that out"},
           {.name = "force", .help = "replace DIR with everything in it, even if it is not a site of ours"},
           report,
           jsonFlag("the report"),
           {.name = "verbose", .aliases = {"-v"}, .help = "list every file that was written"},
           helpFlag()},
      .examples = {"imgeo convert statue.ply -o site", "imgeo convert statue.ply -o site --max-error 0.01%",
                   "imgeo convert scan.stl -o site --up z --rotate y:180 --unit mm --view front",
                   "imgeo convert statue.ply -o site --profile classic --primitives strips",
                   "imgeo convert statue.ply.gz -o site --container bg --normal-bits 16",
                   "imgeo convert house.glb -o site --textures webp --texture-size 2048",
                   "imgeo convert cloud.ply -o site -vp 20 --title \"The cave\"",
                   "imgeo convert scan.ply -o site --keep-attributes intensity",
                   "imgeo convert dem.tif -o terrain --exaggerate 2", "imgeo convert frame-*.ply -o cloth --rate 25",
                   "curl -s https://example.org/part.stl | imgeo convert - -o site",
                   "imgeo convert statue.ply -o site --json | jq .bytesPerTriangle"}};
}

} // namespace imgeo::cli
