#include "cli/flags.h"

#include "cli/choices.h"
#include "containers/encodings.h"
#include "import/format.h"
#include "transcode/sample/box_soup.h"

#include <algorithm>

namespace imgeo::cli {

namespace {

Flag helpFlag() {
  return {.name = "help", .aliases = {"-h"}, .help = "print this help"};
}
Flag jsonFlag(const std::string& what) {
  return {.name = "json", .help = "print " + what + " as JSON"};
}

Flag outsideFlag() {
  return {.name = "outside", .help = "let the source refer to files outside of its folder"};
}

Flag positional(const std::string& name, const std::string& valueName, ValueKind valueKind, const std::string& help) {
  return {
      .name = name, .valueKind = valueKind, .valueName = valueName, .help = help, .positional = true, .required = true};
}

Flag choice(const std::string& name, std::vector<std::string> choices, const std::string& help) {
  return {
      .name = name, .valueKind = ValueKind::choice, .help = help, .defaultValue = choices.front(), .choices = choices};
}

Flag integer(const std::string& name, std::vector<std::string> aliases, std::int64_t min, std::int64_t max,
             const std::string& defaultValue, const std::string& help) {
  return {.name = name,
          .aliases = std::move(aliases),
          .valueKind = ValueKind::integer,
          .valueName = "N",
          .help = help,
          .defaultValue = defaultValue,
          .min = min,
          .max = max};
}

/// `values`, then the different values that a member has in the rows of the encodings.
std::vector<std::string> valuesOf(const char* EncodingRow::*member, std::vector<std::string> values = {}) {
  for (const EncodingRow* row : allEncodings())
    if (std::ranges::find(values, row->*member) == values.end())
      values.emplace_back(row->*member);
  return values;
}

Command convertCommand() {
  Flag input =
      positional("input", "INPUT", ValueKind::file, formatHelp() + " file, gzipped or not; \"-\" reads standard input");
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
           choice("up", namesOf(upChoices),
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
           choice("unit", namesOf(unitChoices),
                  "the unit of the source's numbers, which become metres; auto: what the file says, otherwise m"),
           choice("view", namesOf(viewChoices),
                  "the side that is shown first; auto: the source's viewpoint, otherwise the three-quarter view "
                  "that shows the most of the surface"),
           choice("container", valuesOf(&EncodingRow::container), "sig: PNG images; bg: typed arrays"),
           choice("profile", valuesOf(&EncodingRow::profile, {"auto"}),
                  "of sig. compact: a coarse shape first, then patches, decoded by workers; classic: three "
                  "times its bytes, refined byte by byte, decoded by the GPU, and by X3DOM 1.7 as well; "
                  "auto: compact, but classic with --primitives strips, --index off, --normals palette or "
                  "spherical, more than 30 position bits, 1048576 patch vertices or 13 attributes to keep"),
           choice("as", namesOf(formChoices),
                  "geometry-image: sample surfaces anew on regular grids, one for each chart, without an index; "
                  "height-map: a regular grid of heights as images of them; both in profile classic; "
                  "sequence: animated joints, morph targets and coordinates as recorded frames, "
                  "--rate a second; "
                  "video: frames of a sequence as a lossless video, too"),
           integer("grid", {}, 4, maxGridEdge, "", "geometry images: N * N texels for a mesh, 4..4096, otherwise 256"),
           choice("target", namesOf(targetChoices),
                  "web: a page with its own runtime; x3dom: one for X3DOM 1.7.2 (sig) or 1.8.3 (bg)"),
           {.name = "x3dom-url",
            .valueKind = ValueKind::text,
            .valueName = "URL",
            .help = "target x3dom: the folder that has x3dom.js and x3dom.css; otherwise npm's by "
                    "jsdelivr.net"},
           choice("primitives", namesOf(primitivesChoices),
                  "how patches are drawn, those of lines as lines, line strips or points; a point cloud "
                  "is always points"),
           choice("index", namesOf(indexChoices),
                  "off: vertices are repeated wherever they are drawn instead of named by an index"),
           integer("position-bits", {"-vp", "-qp"}, 8, 32, "",
                   "bits of a coordinate, 8..32, in compact 8..30, on one lattice over the whole mesh; "
                   "otherwise 16, or what the coordinates' type holds; compact takes fewer for a mesh whose "
                   "coordinates lie on a coarser lattice already, and keeps them"),
           {.name = "max-error",
            .valueKind = ValueKind::text,
            .valueName = "LENGTH|PERCENT",
            .help = "sig: the fewest position bits that move no vertex farther, in units of the source or, "
                    "with %, of a mesh's longest edge; geometry images: the smallest grid whose surface is no "
                    "farther off"},
           choice("coord-type", namesOf(coordTypeChoices),
                  "bg: elements of coordinates; auto: the fewest unsigned bytes; float32 without "
                  "--position-bits: the source's numbers"),
           choice("layout", namesOf(layoutChoices),
                  "bg: a file for each attribute, or one of records with all of them beside the index"),
           choice("normals", namesOf(normalsChoices),
                  "how normals are stored: as vectors, as two numbers (compact: always), as 256 directions "
                  "a patch, or in compact not at all"),
           choice("images", namesOf(imagesChoices),
                  "file format of classic's images, both lossless; webp: WebP where it is smaller than PNG, a few "
                  "percent fewer bytes for ten times the encoding time"),
           integer("normal-bits", {"-vn", "-qn"}, 4, 32, "",
                   "bits of a normal's component; classic: 8 or 16, compact: 4..16; bg: 8, 16 or 32; otherwise 8"),
           integer("texcoord-bits", {"-vt", "-qt"}, 1, 32, "",
                   "bits of a texture coordinate; compact: 1..16, otherwise 12; classic: 8, 16 or 24, bg: 8, 16 "
                   "or 32, otherwise 16"),
           integer("color-bits", {"-vc"}, 1, 32, "",
                   "bits of a colour's component; compact: 1..8; classic: 8, 16 or 24, bg: 8, 16 or 32; "
                   "otherwise 8, which is what imgeo reads of sources"),
           integer("patch-vertices", {}, 256, 4194304, "65535",
                   "the most vertices in one patch, 256..4194304; more than 65535 take 32-bit indices"),
           {.name = "base",
            .valueKind = ValueKind::text,
            .valueName = "PERCENT",
            .help = "compact: a first shape of so many of the triangles in 100, 0..25; 0: none, otherwise 2"},
           choice("instances", namesOf(instancesChoices),
                  "auto: a mesh that is another one, moved or turned, is stored once, and shapes of it become "
                  "instances; never: only what the source instances"),
           choice("levels", namesOf(levelsChoices),
                  "compact: levels of detail, of which pages load what a view needs; auto: of meshes of more than "
                  "2,000,000 triangles, or points"),
           integer("group-triangles", {}, 256, 262144, "32768",
                   "levels: the most triangles, or points, in one file, 256..262144"),
           integer("region-triangles", {}, 4096, 4194304, "1048576",
                   "levels: about how many triangles, or points, are cut into files at a time, 4096..4194304"),
           {.name = "memory",
            .valueKind = ValueKind::text,
            .valueName = "SIZE",
            .help = "levels: the memory to use, as 1G or 800M; sources in PLY, binary STL, OBJ, GLB, LAS, E57 and PTS "
                    "that take more "
                    "are converted out of core, region by region; otherwise three quarters of the machine's"},
           {.name = "work",
            .valueKind = ValueKind::text,
            .valueName = "FOLDER",
            .help =
                "convert out of core, with intermediate files in this folder; otherwise, and where it has to be, in "
                ".DIR.imgeo-work beside DIR"},
           {.name = "resume", .help = "out of core: go on where an earlier run of the same command ended"},
           integer("ranks", {}, 1, 65536, "1",
                   "out of core: how many processes with the same options share the work folder and the work, on one "
                   "machine or many"),
           integer("rank", {}, 0, 65535, "0", "the number of this process among them; 0 writes the site"),
           integer("silence", {}, 1, 604800, "120",
                   "ranks: seconds without a sign of life of another rank after which this one ends"),
           choice("drop", namesOf(dropChoices),
                  "which elements to leave out: those with two corners at one place, those that repeat "
                  "another, or both"),
           {.name = "keep-attributes",
            .valueKind = ValueKind::text,
            .valueName = "NAMES",
            .help = "further numbers of PLY's vertices to keep: names with commas between, all or none",
            .defaultValue = "none"},
           integer("attribute-bits", {}, 8, 24, "",
                   "bits of such a number; sig: 8, 16 or 24, otherwise 16; bg holds floats"),
           choice("textures", namesOf(texturesChoices),
                  "what images of textures are written as; keep: as they are, and those that no browser "
                  "shows (TGA, TIFF, BMP ...) as lossless WebP. Normal maps and other data are never lossy"),
           integer("texture-size", {}, 1, 16383, "",
                   "the longest edge of a texture in pixels; larger ones are made smaller, none larger"),
           integer("texture-quality", {}, 0, 100, "", "of lossy textures; otherwise 80 of webp, 60 of avif"),
           integer("texture-preview", {}, 0, 256, "64",
                   "the longest edge of what is shown first of a large texture; 0: nothing is"),
           choice("normal-weighting", namesOf(normalWeightingChoices),
                  "how triangles count in normals that the source lacks"),
           {.name = "title",
            .valueKind = ValueKind::text,
            .valueName = "TEXT",
            .help = "the page's title; otherwise the input's name"},
           {.name = "no-pictures",
            .help = "leave out icon.png and picture.png, the pictures of tabs and of previews of links"},
           integer("effort", {}, 0, 9, "5", "how hard to compress: 0 fastest, 9 smallest; in compact 1 to 6 are one"),
           integer("threads", {}, 0, 1024, "0",
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

Command infoCommand() {
  return {.name = "info",
          .usage = "PATH [--json]",
          .summary = "say what a site or a mesh file holds, and where its bytes are",
          .text = "PATH is a site's directory, its index.html or scene.x3d, a file of vertex data, or a mesh to "
                  "convert.",
          .flags = {positional("path", "PATH", ValueKind::file, "a site or a file"), outsideFlag(), jsonFlag("it"),
                    helpFlag()},
          .examples = {"imgeo info site", "imgeo info site --json | jq .documentBytes", "imgeo info statue.ply"}};
}

Command verifyCommand() {
  Flag input = positional("input", "INPUT", ValueKind::file,
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
              "pictures what imgeo.json says; in a site of another program only that it is there. A mesh or a "
              "cloud with levels of detail that memory does not hold is compared out of core, region by region, with "
              "the files that convert reads so. Exits with 0 only if all of that is so, with 3 if not.",
      .flags = {positional("site", "DIR", ValueKind::directory, "the site"),
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

Flag meshFileFlag() {
  return {.name = "output",
          .aliases = {"-o"},
          .valueKind = ValueKind::file,
          .valueName = "FILE",
          .help = "the file to write; .ply, .obj or .glb says what",
          .required = true};
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
      .flags = {positional("input", "INPUT", ValueKind::file,
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

Flag textFlag(const std::string& name, const std::string& valueName, const std::string& help) {
  return {.name = name, .valueKind = ValueKind::text, .valueName = valueName, .help = help};
}

Command exportCommand() {
  return {.name = "export",
          .usage = "DIR -o FILE [--frame N|all]",
          .summary = "write the mesh that a site holds as PLY, OBJ or GLB",
          .text = "Reads a site back, joins the patches of each mesh and writes all shapes into one file. "
                  "Reads sites that aopt wrote for X3DOM, too.",
          .flags = {positional("site", "DIR", ValueKind::directory, "the site, its index.html or a .x3d file"),
                    meshFileFlag(),
                    textFlag("frame", "N|all", "of a sequence: this frame, from 0; all: FILE-0000, FILE-0001 ..."),
                    integer("level", {}, 0, 31, "0",
                            "of meshes with levels of detail: 0, the whole mesh, or a coarser one"),
                    jsonFlag("what was written"), helpFlag()},
          .examples = {"imgeo export site -o statue.ply", "imgeo export old/statue.x3d -o statue.glb",
                       "imgeo export cloth -o frames/cloth.ply --frame all"}};
}

/// The options of commands that listen.
Flag hostFlag() {
  Flag flag = textFlag("host", "A", "the address to listen on; 0.0.0.0 for every network");
  flag.defaultValue = "127.0.0.1";
  return flag;
}
Flag portFlag(const std::string& defaultValue) {
  return integer("port", {}, 0, 65535, defaultValue, "the port to listen on; 0: any that is free");
}
Flag publishTokenFlag(const std::string& help) {
  return textFlag("token", "TOKEN", help + "; otherwise the variable IMGEO_TOKEN");
}
Flag viewTokenFlag() {
  return textFlag("view-token", "TOKEN",
                  "with --live: viewers add ?token=TOKEN to addresses of streams that have no token of their own");
}

Command sampleCommand() {
  Flag what = positional("sample", "SAMPLE", ValueKind::choice,
                         "hall: rows of seats, stairs, columns, trusses, signs. relief: a closed surface of any size. "
                         "boxes: a building of unconnected boxes. Motions: cloth in the wind; water: drops fall "
                         "into a basin; turntable: a laser scanner turns in a street");
  what.choices = {"hall", "relief", "boxes", "cloth", "water", "turntable"};
  Flag output{.name = "output",
              .aliases = {"-o"},
              .valueKind = ValueKind::file,
              .valueName = "FILE",
              .help =
                  "of hall: the GLB file to write; of relief and boxes: the PLY file; of a motion: a folder for its "
                  "frames"};
  Flag site{.name = "site",
            .valueKind = ValueKind::directory,
            .valueName = "DIR",
            .help = "with --live: serve this directory instead of a page that draws the motion"};
  return {
      .name = "sample",
      .usage = "SCENE -o FILE | MOTION --live | MOTION --frames N -o DIR",
      .summary = "write a generated scene, or write or publish a moving one",
      .text = "All seats of the hall are one mesh in many places, so that the file stays small. With --live, a "
              "simulation runs until Ctrl-C and its vertices are a live stream; with --frames its frames are "
              "PLY files, which convert turns into a sequence.",
      .flags = {what,
                integer("seats", {}, 1, 100000, "1000", "how many seats the hall has"),
                integer("triangles", {}, 12, 8000000000, "1000000", "about how many triangles the relief has"),
                integer("points", {}, 0, 4000000000, "0",
                        "relief: a cloud of about so many points of it, with colours, intensity and "
                        "classification, in place of triangles"),
                integer("charts", {}, 0, 6000000, "0",
                        "relief: texture coordinates in an atlas of about so many charts, in an order without "
                        "neighbours"),
                integer("count", {}, 1, BoxSoup::maxCount, "10000", "how many boxes"),
                {.name = "shuffled",
                 .help = "relief: vertices and triangles, or points, in an order without neighbours; boxes: likewise"},
                output,
                {.name = "live", .help = "serve the motion as a live stream at /live/SAMPLE"},
                integer("grid", {}, 8, 2048, "128", "motions: N x N vertices"),
                integer("rate", {}, 1, 1000, "30", "motions: frames per second"),
                integer("bits", {}, 8, 24, "16", "with --live: bits of a coordinate"),
                integer("seed", {}, 0, 4294967295, "1", "motions, boxes: another number, another motion, other boxes"),
                integer("frames", {}, 0, 1000000000, "0", "motions: so many frames; with --live, 0: without end"),
                portFlag("8090"),
                hostFlag(),
                site,
                publishTokenFlag("with --live: lets others publish here, too"),
                viewTokenFlag(),
                jsonFlag("what was written"),
                helpFlag()},
      .examples = {"imgeo sample hall --seats 2000 -o hall.glb && imgeo convert hall.glb -o site",
                   "imgeo sample cloth --live --grid 256 --rate 30",
                   "imgeo sample cloth --frames 300 -o frames && imgeo convert 'frames/*.ply' -o cloth"}};
}

Command serveCommand() {
  Flag site = positional("site", "DIR", ValueKind::directory, "the directory to serve; with --live it may be left out");
  site.required = false;
  return {.name = "serve",
          .usage = "DIR [--live] [--port N] [--host A]",
          .summary = "serve a directory over HTTP until Ctrl-C",
          .text = "Prints the address when it listens. With --live, programs publish vertex streams below /live/, and "
                  "any number of browsers draw them.",
          .flags = {site,
                    portFlag("8080"),
                    hostFlag(),
                    {.name = "live", .help = "take live streams and serve them to viewers"},
                    publishTokenFlag("with --live: what publishers state; without it nobody may publish"),
                    viewTokenFlag(),
                    integer("max-streams", {}, 1, 10000, "16", "with --live: streams at a time"),
                    integer("max-frame", {}, 1, 16384, "16384", "with --live: KiB of a frame as it is sent"),
                    integer("max-rate", {}, 0, 1000, "0", "with --live: frames per second of a stream; 0: no limit"),
                    helpFlag()},
          .examples = {"imgeo serve site", "imgeo serve site --port 0 --host 0.0.0.0",
                       "imgeo serve site --live --token secret"}};
}

Command publishCommand() {
  Flag input = positional("input", "FILE", ValueKind::file,
                          "frames, one file after the other; otherwise standard input has them");
  input.required = false;
  input.repeatable = true;
  Flag box = textFlag("box", "NUMBERS", "the smallest x,y,z and the largest; others are clamped");
  box.required = true;
  Flag name = textFlag("name", "NAME", "the stream's name: /live/NAME");
  name.defaultValue = "stream";
  return {.name = "publish",
          .usage = "--box X,Y,Z,X,Y,Z [options] [FILE...]",
          .summary = "publish frames of a pipe or of files as a live stream",
          .text =
              "Frames are PLY files, in text or binary, one behind the other (in text with a line for each vertex), "
              "or 32-bit floats, little-endian: x y z of all vertices, then the normals, the colours and the "
              "values of all of them, where the stream has them.",
          .flags = {input,
                    textFlag("vertices", "N|CxR",
                             "the vertices, or columns and rows of their grid; of PLY files as many as the first has"),
                    box,
                    name,
                    integer("bits", {}, 8, 24, "16", "bits of a coordinate"),
                    integer("normals", {}, 0, 16, "0", "bits of a normal's number, 8..16; 0: there are no normals"),
                    integer("colors", {}, 0, 4, "0", "components of a colour, 3 or 4 from 0 to 1; 0: none"),
                    textFlag("values", "NUMBERS", "the smallest and the largest value of each component"),
                    textFlag("attribute", "NAME", "of PLY files: the property that has the values"),
                    integer("rate", {}, 0, 1000, "0",
                            "frames per second; faster ones are dropped. 0: no limit, 30 for files"),
                    {.name = "loop", .help = "begin again after the last file"},
                    textFlag("to", "URL", "the server to publish to; otherwise this command is the server"),
                    textFlag("token", "TOKEN", "with --to: the server's token; otherwise the variable IMGEO_TOKEN"),
                    textFlag("view-token", "TOKEN", "viewers add ?token=TOKEN to the address of this stream"),
                    portFlag("8090"),
                    hostFlag(),
                    helpFlag()},
          .examples = {"./simulation | imgeo publish --vertices 128x128 --box -1,-1,-1,1,1,1 --rate 30",
                       "imgeo publish walk-*.ply --box -1,0,-1,1,2,1 --rate 24 --loop",
                       "./scanner | imgeo publish --vertices 50000 --box -40,-3,-40,40,20,40 --name street "
                       "--to http://example.org:8080 --token secret"}};
}

Command completionCommand() {
  Flag shell = positional("shell", "SHELL", ValueKind::choice, "bash, zsh or fish");
  shell.choices = {"bash", "zsh", "fish"};
  return {.name = "completion",
          .usage = "SHELL",
          .summary = "print a completion script for bash, zsh or fish",
          .text = "",
          .flags = {shell, helpFlag()},
          .examples = {"imgeo completion bash > ~/.local/share/bash-completion/completions/imgeo",
                       "imgeo completion zsh > ~/.zfunc/_imgeo",
                       "imgeo completion fish > ~/.config/fish/completions/imgeo.fish"}};
}

Command manualCommand() {
  return {.name = "manual",
          .usage = "",
          .summary = "print the manual page",
          .text = "",
          .flags = {helpFlag()},
          .examples = {"imgeo manual > imgeo.1 && man ./imgeo.1"}};
}

} // namespace

std::span<const Command> commands() {
  static const std::vector<Command> all{convertCommand(),    infoCommand(),   verifyCommand(), exportCommand(),
                                        transformCommand(),  sampleCommand(), serveCommand(),  publishCommand(),
                                        completionCommand(), manualCommand()};
  return all;
}

const Command* findCommand(const std::string& name) {
  const auto found = std::ranges::find(commands(), name, &Command::name);
  return found == commands().end() ? nullptr : &*found;
}

std::span<const ExitCode> exitCodes() {
  static const std::vector<ExitCode> all{
      {0, "done; for verify: equal"},
      {1, "wrong usage: an option that cannot be honoured, a directory that is not ours"},
      {2, "a file could not be read or written, an address not be had"},
      {3, "bad input: truncated, malformed, unsupported or too large; for verify: not equal"},
      {4, "an internal fault"}};
  return all;
}

} // namespace imgeo::cli
