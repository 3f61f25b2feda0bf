#include "cli/live_flags.h"

#include "cli/common_flags.h"
#include "transcode/sample/box_soup.h"

namespace imgeo::cli {

namespace {

/// The options of commands that listen.
Flag hostFlag() {
  Flag flag = textFlag("host", "A", "the address to listen on; 0.0.0.0 for every network");
  flag.defaultValue = "127.0.0.1";
  return flag;
}
Flag portFlag(const std::string& defaultValue) {
  return integerFlag("port", {}, 0, 65535, defaultValue, "the port to listen on; 0: any that is free");
}
Flag publishTokenFlag(const std::string& help) {
  return textFlag("token", "TOKEN", help + "; otherwise the variable IMGEO_TOKEN");
}
Flag viewTokenFlag() {
  return textFlag("view-token", "TOKEN",
                  "with --live: viewers add ?token=TOKEN to addresses of streams that have no token of their own");
}

} // namespace

Command sampleCommand() {
  Flag what =
      positionalFlag("sample", "SAMPLE", ValueKind::choice,
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
                integerFlag("seats", {}, 1, 100000, "1000", "how many seats the hall has"),
                integerFlag("triangles", {}, 12, 8000000000, "1000000", "about how many triangles the relief has"),
                integerFlag("points", {}, 0, 4000000000, "0",
                            "relief: a cloud of about so many points of it, with colours, intensity and "
                            "classification, in place of triangles"),
                integerFlag("charts", {}, 0, 6000000, "0",
                            "relief: texture coordinates in an atlas of about so many charts, in an order without "
                            "neighbours"),
                integerFlag("count", {}, 1, BoxSoup::maxCount, "10000", "how many boxes"),
                {.name = "shuffled",
                 .help = "relief: vertices and triangles, or points, in an order without neighbours; boxes: likewise"},
                output,
                {.name = "live", .help = "serve the motion as a live stream at /live/SAMPLE"},
                integerFlag("grid", {}, 8, 2048, "128", "motions: N x N vertices"),
                integerFlag("rate", {}, 1, 1000, "30", "motions: frames per second"),
                integerFlag("bits", {}, 8, 24, "16", "with --live: bits of a coordinate"),
                integerFlag("seed", {}, 0, 4294967295, "1",
                            "motions, boxes: another number, another motion, other boxes"),
                integerFlag("frames", {}, 0, 1000000000, "0", "motions: so many frames; with --live, 0: without end"),
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
  Flag site =
      positionalFlag("site", "DIR", ValueKind::directory, "the directory to serve; with --live it may be left out");
  site.required = false;
  return {
      .name = "serve",
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
                integerFlag("max-streams", {}, 1, 10000, "16", "with --live: streams at a time"),
                integerFlag("max-frame", {}, 1, 16384, "16384", "with --live: KiB of a frame as it is sent"),
                integerFlag("max-rate", {}, 0, 1000, "0", "with --live: frames per second of a stream; 0: no limit"),
                helpFlag()},
      .examples = {"imgeo serve site", "imgeo serve site --port 0 --host 0.0.0.0",
                   "imgeo serve site --live --token secret"}};
}

Command publishCommand() {
  Flag input = positionalFlag("input", "FILE", ValueKind::file,
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
                    integerFlag("bits", {}, 8, 24, "16", "bits of a coordinate"),
                    integerFlag("normals", {}, 0, 16, "0", "bits of a normal's number, 8..16; 0: there are no normals"),
                    integerFlag("colors", {}, 0, 4, "0", "components of a colour, 3 or 4 from 0 to 1; 0: none"),
                    textFlag("values", "NUMBERS", "the smallest and the largest value of each component"),
                    textFlag("attribute", "NAME", "of PLY files: the property that has the values"),
                    integerFlag("rate", {}, 0, 1000, "0",
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

} // namespace imgeo::cli
