// Makes a page to walk through a hall (paper, figure 1): the visitor stands on the ground, walks with the arrow keys or
// with two fingers, and a second viewpoint is before the steps of the stage.

/** Turns `page`, the index.html of a converted hall, into a walk. */
export function walkPage(page: string, title: string, text: string): string {
  return page
    .replace(/<title>[^<]*<\/title>/, `<title>${title}</title>`)
    .replace(/(<link rel="stylesheet"[^>]*>)/, `$1\n    <link rel="stylesheet" href="hall.css">`)
    .replace(
      /<NavigationInfo[^>]*>/i,
      '<NavigationInfo headlight="false" type=\'"WALK" "FLY" "EXAMINE"\' avatarSize="0.25 1.6 0.4" speed="3">',
    )
    .replace(/<\/Scene>/i, '<Viewpoint description="Before the steps" position="7 2 4"></Viewpoint>$&')
    .replace(/<X3D([^>]*)>/i, `<X3D$1 alt="${title}">`)
    .replace(/<\/X3D>/i, `$&\n    <p class="text">${text}</p>`);
}
