// Makes a museum's page for one object. The object turns by itself until the user moves it, the
// key P displays its points, and notes about it are buttons at the points that they describe.

/** A note, and the point of the object that it describes. */
export interface Note {
  readonly name: string;
  readonly text: string;
  readonly position: readonly [number, number, number];
  readonly normal: readonly [number, number, number];
}

/** Adds a title, a text and notes to `page`, the index.html of a converted site. */
export function museumPage(page: string, title: string, text: string, notes: readonly Note[]): string {
  const hotspots = notes.map(
    ({ name, position, normal }, i) =>
      `<button slot="hotspot-${i}" class="note" popovertarget="note-${i}" data-position="${position.join(" ")}" data-normal="${normal.join(" ")}">${name}</button>`,
  );
  const popovers = notes.map(
    ({ name, text: note }, i) => `<aside id="note-${i}" popover><h2>${name}</h2><p>${note}</p></aside>`,
  );
  return page
    .replace(/<title>[^<]*<\/title>/, `<title>${title}</title>`)
    .replace(/(<link rel="stylesheet"[^>]*>)/, `$1\n    <link rel="stylesheet" href="museum.css">`)
    .replace(/<\/Appearance>/i, '<PointProperties pointSizeScaleFactor="1"></PointProperties>$&')
    .replace(
      /<X3D([^>]*)>/i,
      `<main><h1>${title}</h1><p>${text}</p>\n    <X3D$1 alt="${title}" auto-rotate auto-rotate-delay="1000" rotation-per-second="15deg">`,
    )
    .replace(/<\/X3D>/i, `  ${hotspots.join("\n      ")}\n    $&\n    ${popovers.join("\n    ")}\n    </main>`);
}
