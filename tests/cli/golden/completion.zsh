#compdef imgeo

_imgeo() {
  local -a commands=(
    'convert:turn a mesh into a page that shows it progressively'
    'info:say what a site or a mesh file holds, and where its bytes are'
    'verify:read a site back and prove that it equals its input'
    'export:write the mesh that a site holds as PLY, OBJ or GLB'
    'transform:map the vertices of a mesh by image operators'
    'sample:write a generated scene, or write or publish a moving one'
    'serve:serve a directory over HTTP until Ctrl-C'
    'publish:publish frames of a pipe or of files as a live stream'
    'completion:print a completion script for bash, zsh or fish'
    'manual:print the manual page'
  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
    convert) _arguments \
      '-i[X3D, HTML, VRML, glTF, GLB, PLY, OBJ, STL, OFF, LAS, E57, PTS, GeoTIFF or XYZ file, gzipped or not; "-" reads standard input; several files, or a pattern in quotes, are the frames of a sequence, in the order of their numbers]:input:_files' \
      '--input[X3D, HTML, VRML, glTF, GLB, PLY, OBJ, STL, OFF, LAS, E57, PTS, GeoTIFF or XYZ file, gzipped or not; "-" reads standard input; several files, or a pattern in quotes, are the frames of a sequence, in the order of their numbers]:input:_files' \
      '-o[the site'\''s directory; an older site there is replaced in one step]:output:_files -/' \
      '--output[the site'\''s directory; an older site there is replaced in one step]:output:_files -/' \
      '--up[the source'\''s axis that points up; auto\: what the format says, and for OBJ, PLY, STL and others that do not say it a guess by the shape, which is printed with its reason]:up:(auto x y z -x -y -z)' \
      '--rotate[then turn the source\: y\:90 about the upward axis, x\:-30,y\:90 about x first]:rotate: ' \
      '--scale[then multiply its lengths]:scale: ' \
      '--exaggerate[then multiply its heights, as maps of terrain do]:exaggerate: ' \
      '--rate[sequences\: frames per second]:rate: ' \
      '--unit[the unit of the source'\''s numbers, which become metres; auto\: what the file says, otherwise m]:unit:(auto m cm mm um km in ft yd mi)' \
      '--view[the side that is shown first; auto\: the source'\''s viewpoint, otherwise the three-quarter view that shows the most of the surface]:view:(auto front left back right top bottom)' \
      '--container[sig\: PNG images; bg\: typed arrays]:container:(sig bg)' \
      '--profile[of sig. compact\: a coarse shape first, then patches, decoded by workers; classic\: three times its bytes, refined byte by byte, decoded by the GPU, and by X3DOM 1.7 as well; auto\: compact, but classic with --primitives strips, --index off, --normals palette or spherical, more than 30 position bits, 1048576 patch vertices or 13 attributes to keep]:profile:(auto compact classic)' \
      '--as[geometry-image\: sample surfaces anew on regular grids, one for each chart, without an index; height-map\: a regular grid of heights as images of them; both in profile classic; sequence\: animated joints, morph targets and coordinates as recorded frames, --rate a second; video\: frames of a sequence as a lossless video, too]:as:(mesh geometry-image height-map sequence video)' \
      '--grid[geometry images\: N * N texels for a mesh, 4..4096, otherwise 256]:grid: ' \
      '--target[web\: a page with its own runtime; x3dom\: one for X3DOM 1.7.2 (sig) or 1.8.3 (bg)]:target:(web x3dom)' \
      '--x3dom-url[target x3dom\: the folder that has x3dom.js and x3dom.css; otherwise npm'\''s by jsdelivr.net]:x3dom-url: ' \
      '--primitives[how patches are drawn, those of lines as lines, line strips or points; a point cloud is always points]:primitives:(triangles strips points)' \
      '--index[off\: vertices are repeated wherever they are drawn instead of named by an index]:index:(on off)' \
      '-vp[bits of a coordinate, 8..32, in compact 8..30, on one lattice over the whole mesh; otherwise 16, or what the coordinates'\'' type holds; compact takes fewer for a mesh whose coordinates lie on a coarser lattice already, and keeps them]:position-bits: ' \
      '-qp[bits of a coordinate, 8..32, in compact 8..30, on one lattice over the whole mesh; otherwise 16, or what the coordinates'\'' type holds; compact takes fewer for a mesh whose coordinates lie on a coarser lattice already, and keeps them]:position-bits: ' \
      '--position-bits[bits of a coordinate, 8..32, in compact 8..30, on one lattice over the whole mesh; otherwise 16, or what the coordinates'\'' type holds; compact takes fewer for a mesh whose coordinates lie on a coarser lattice already, and keeps them]:position-bits: ' \
      '--max-error[sig\: the fewest position bits that move no vertex farther, in units of the source or, with %, of a mesh'\''s longest edge; geometry images\: the smallest grid whose surface is no farther off]:max-error: ' \
      '--coord-type[bg\: elements of coordinates; auto\: the fewest unsigned bytes; float32 without --position-bits\: the source'\''s numbers]:coord-type:(auto uint8 int8 uint16 int16 float32)' \
      '--layout[bg\: a file for each attribute, or one of records with all of them beside the index]:layout:(separate interleaved)' \
      '--normals[how normals are stored\: as vectors, as two numbers (compact\: always), as 256 directions a patch, or in compact not at all]:normals:(rgb octahedral spherical palette derived)' \
      '--images[file format of classic'\''s images, both lossless; webp\: WebP where it is smaller than PNG, a few percent fewer bytes for ten times the encoding time]:images:(png webp)' \
      '-vn[bits of a normal'\''s component; classic\: 8 or 16, compact\: 4..16; bg\: 8, 16 or 32; otherwise 8]:normal-bits: ' \
      '-qn[bits of a normal'\''s component; classic\: 8 or 16, compact\: 4..16; bg\: 8, 16 or 32; otherwise 8]:normal-bits: ' \
      '--normal-bits[bits of a normal'\''s component; classic\: 8 or 16, compact\: 4..16; bg\: 8, 16 or 32; otherwise 8]:normal-bits: ' \
      '-vt[bits of a texture coordinate; compact\: 1..16, otherwise 12; classic\: 8, 16 or 24, bg\: 8, 16 or 32, otherwise 16]:texcoord-bits: ' \
      '-qt[bits of a texture coordinate; compact\: 1..16, otherwise 12; classic\: 8, 16 or 24, bg\: 8, 16 or 32, otherwise 16]:texcoord-bits: ' \
      '--texcoord-bits[bits of a texture coordinate; compact\: 1..16, otherwise 12; classic\: 8, 16 or 24, bg\: 8, 16 or 32, otherwise 16]:texcoord-bits: ' \
      '-vc[bits of a colour'\''s component; compact\: 1..8; classic\: 8, 16 or 24, bg\: 8, 16 or 32; otherwise 8, which is what imgeo reads of sources]:color-bits: ' \
      '--color-bits[bits of a colour'\''s component; compact\: 1..8; classic\: 8, 16 or 24, bg\: 8, 16 or 32; otherwise 8, which is what imgeo reads of sources]:color-bits: ' \
      '--patch-vertices[the most vertices in one patch, 256..4194304; more than 65535 take 32-bit indices]:patch-vertices: ' \
      '--base[compact\: a first shape of so many of the triangles in 100, 0..25; 0\: none, otherwise 2]:base: ' \
      '--instances[auto\: a mesh that is another one, moved or turned, is stored once, and shapes of it become instances; never\: only what the source instances]:instances:(auto never)' \
      '--levels[compact\: levels of detail, of which pages load what a view needs; auto\: of meshes of more than 2,000,000 triangles, or points]:levels:(auto always never)' \
      '--group-triangles[levels\: the most triangles, or points, in one file, 256..262144]:group-triangles: ' \
      '--region-triangles[levels\: about how many triangles, or points, are cut into files at a time, 4096..4194304]:region-triangles: ' \
      '--memory[levels\: the memory to use, as 1G or 800M; sources in PLY, binary STL, OBJ, GLB, LAS, E57, PTS and XYZ that take more are converted out of core, region by region; otherwise three quarters of the machine'\''s]:memory: ' \
      '--work[convert out of core, with intermediate files in this folder; otherwise, and where it has to be, in .DIR.imgeo-work beside DIR]:work: ' \
      '--resume[out of core\: go on where an earlier run of the same command ended]' \
      '--ranks[out of core\: how many processes with the same options share the work folder and the work, on one machine or many]:ranks: ' \
      '--rank[the number of this process among them; 0 writes the site]:rank: ' \
      '--silence[ranks\: seconds without a sign of life of another rank after which this one ends]:silence: ' \
      '--drop[which elements to leave out\: those with two corners at one place, those that repeat another, or both]:drop:(none degenerate repeated both)' \
      '--keep-attributes[further numbers of vertices and points to keep\: names with commas between, all or none]:keep-attributes: ' \
      '--attribute-bits[bits of such a number; sig\: 8, 16 or 24, otherwise 16; bg holds floats]:attribute-bits: ' \
      '--textures[what images of textures are written as; keep\: as they are, and those that no browser shows (TGA, TIFF, BMP ...) as lossless WebP. Normal maps and other data are never lossy]:textures:(keep webp avif png)' \
      '--texture-size[the longest edge of a texture in pixels; larger ones are made smaller, none larger]:texture-size: ' \
      '--texture-quality[of lossy textures; otherwise 80 of webp, 60 of avif]:texture-quality: ' \
      '--texture-preview[the longest edge of what is shown first of a large texture; 0\: nothing is]:texture-preview: ' \
      '--normal-weighting[how triangles count in normals that the source lacks]:normal-weighting:(area angle uniform)' \
      '--crease-angle[of normals that the source lacks\: edges at which triangles meet at a larger angle are sharp, 0\: all, 180\: none; otherwise 0 in glTF, 39 in formats of man-made objects (IFC, Collada, FBX ...), and a guess by the shape in PLY, OBJ, STL and OFF\: 39 or 180]:crease-angle: ' \
      '--title[the page'\''s title; otherwise the input'\''s name]:title: ' \
      '--no-pictures[leave out icon.png and picture.png, the pictures of tabs and of previews of links]' \
      '--effort[how hard to compress\: 0 fastest, 9 smallest; in compact 1 to 6 are one]:effort: ' \
      '--threads[how many threads to use; 0\: all. The site is the same with any number]:threads: ' \
      '--precompress[write FILE.br and FILE.gz beside text and BG'\''s arrays, for hosts that do not compress]' \
      '--outside[let the source refer to files outside of its folder]' \
      '--strict[refuse a source of which a part is damaged, instead of leaving that out]' \
      '--force[replace DIR with everything in it, even if it is not a site of ours]' \
      '-r[write a report of what was chosen and measured, as JSON]:report:_files' \
      '--report[write a report of what was chosen and measured, as JSON]:report:_files' \
      '--json[print the report as JSON]' \
      '-v[list every file that was written]' \
      '--verbose[list every file that was written]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':input:_files' ;;
    info) _arguments \
      '--outside[let the source refer to files outside of its folder]' \
      '--json[print it as JSON]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':path:_files' ;;
    verify) _arguments \
      '--memory[the memory to use, as 1G or 800M, at least 256M; meshes and clouds with levels of detail that take more are compared out of core, if convert reads their source so; otherwise three quarters of the machine'\''s]:memory: ' \
      '--work[compare out of core, with intermediate files in this folder, which are removed; otherwise, and where it has to be, in .DIR.imgeo-verify beside DIR]:work: ' \
      '--outside[let the source refer to files outside of its folder]' \
      '--json[print the result as JSON]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':site:_files -/' \
      ':input:_files' ;;
    export) _arguments \
      '-o[the file to write; .ply, .obj or .glb says what]:output:_files' \
      '--output[the file to write; .ply, .obj or .glb says what]:output:_files' \
      '--frame[of a sequence\: this frame, from 0; all\: FILE-0000, FILE-0001 ...]:frame: ' \
      '--level[of meshes with levels of detail\: 0, the whole mesh, or a coarser one]:level: ' \
      '--json[print what was written as JSON]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':site:_files -/' ;;
    transform) _arguments \
      '-o[the file to write; .ply, .obj or .glb says what]:output:_files' \
      '--output[the file to write; .ply, .obj or .glb says what]:output:_files' \
      '--operators[operators in their order, such as "scale(0.8) negate(x)"; after those of a site'\''s nodes]:operators: ' \
      '--outside[let the source refer to files outside of its folder]' \
      '--json[print what was written as JSON]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':input:_files' ;;
    sample) _arguments \
      '--seats[how many seats the hall has]:seats: ' \
      '--triangles[about how many triangles the relief has]:triangles: ' \
      '--points[relief\: a cloud of about so many points of it, with colours, intensity and classification, in place of triangles]:points: ' \
      '--charts[relief\: texture coordinates in an atlas of about so many charts, in an order without neighbours]:charts: ' \
      '--count[how many boxes]:count: ' \
      '--shuffled[relief\: vertices and triangles, or points, in an order without neighbours; boxes\: likewise]' \
      '-o[of hall\: the GLB file to write; of relief and boxes\: the PLY file; of a motion\: a folder for its frames]:output:_files' \
      '--output[of hall\: the GLB file to write; of relief and boxes\: the PLY file; of a motion\: a folder for its frames]:output:_files' \
      '--live[serve the motion as a live stream at /live/SAMPLE]' \
      '--grid[motions\: N x N vertices]:grid: ' \
      '--rate[motions\: frames per second]:rate: ' \
      '--bits[with --live\: bits of a coordinate]:bits: ' \
      '--seed[motions, boxes\: another number, another motion, other boxes]:seed: ' \
      '--frames[motions\: so many frames; with --live, 0\: without end]:frames: ' \
      '--port[the port to listen on; 0\: any that is free]:port: ' \
      '--host[the address to listen on; 0.0.0.0 for every network]:host: ' \
      '--site[with --live\: serve this directory instead of a page that draws the motion]:site:_files -/' \
      '--token[with --live\: lets others publish here, too; otherwise the variable IMGEO_TOKEN]:token: ' \
      '--view-token[with --live\: viewers add ?token=TOKEN to addresses of streams that have no token of their own]:view-token: ' \
      '--json[print what was written as JSON]' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':sample:(hall relief boxes cloth water turntable)' ;;
    serve) _arguments \
      '--port[the port to listen on; 0\: any that is free]:port: ' \
      '--host[the address to listen on; 0.0.0.0 for every network]:host: ' \
      '--live[take live streams and serve them to viewers]' \
      '--token[with --live\: what publishers state; without it nobody may publish; otherwise the variable IMGEO_TOKEN]:token: ' \
      '--view-token[with --live\: viewers add ?token=TOKEN to addresses of streams that have no token of their own]:view-token: ' \
      '--max-streams[with --live\: streams at a time]:max-streams: ' \
      '--max-frame[with --live\: KiB of a frame as it is sent]:max-frame: ' \
      '--max-rate[with --live\: frames per second of a stream; 0\: no limit]:max-rate: ' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':site:_files -/' ;;
    publish) _arguments \
      '--vertices[the vertices, or columns and rows of their grid; of PLY files as many as the first has]:vertices: ' \
      '--box[the smallest x,y,z and the largest; others are clamped]:box: ' \
      '--name[the stream'\''s name\: /live/NAME]:name: ' \
      '--bits[bits of a coordinate]:bits: ' \
      '--normals[bits of a normal'\''s number, 8..16; 0\: there are no normals]:normals: ' \
      '--colors[components of a colour, 3 or 4 from 0 to 1; 0\: none]:colors: ' \
      '--values[the smallest and the largest value of each component]:values: ' \
      '--attribute[of PLY files\: the property that has the values]:attribute: ' \
      '--rate[frames per second; faster ones are dropped. 0\: no limit, 30 for files]:rate: ' \
      '--loop[begin again after the last file]' \
      '--to[the server to publish to; otherwise this command is the server]:to: ' \
      '--token[with --to\: the server'\''s token; otherwise the variable IMGEO_TOKEN]:token: ' \
      '--view-token[viewers add ?token=TOKEN to the address of this stream]:view-token: ' \
      '--port[the port to listen on; 0\: any that is free]:port: ' \
      '--host[the address to listen on; 0.0.0.0 for every network]:host: ' \
      '-h[print this help]' \
      '--help[print this help]' \
      ':input:_files' ;;
    completion) _arguments \
      '-h[print this help]' \
      '--help[print this help]' \
      ':shell:(bash zsh fish)' ;;
    manual) _arguments \
      '-h[print this help]' \
      '--help[print this help]' ;;
  esac
}

_imgeo "$@"
