// Makes a page of scenes that move.

export interface MovingScene {
  /** The folder of its site. */
  readonly folder: string;
  readonly title: string;
  /** What to do with it, as HTML. */
  readonly text: string;
}

/** The page, beside the folders of the sites; all of them use the runtime of the first. */
export function motionPage(scenes: readonly MovingScene[]): string {
  const [first] = scenes;
  if (first === undefined) throw new Error("no scenes");
  const figures = scenes.map(
    ({ folder, title, text }) => `    <figure>
      <imgeo-viewer src="${folder}/" alt="${title}"></imgeo-viewer>
      <figcaption>
        <h2>${title}</h2>
        <p>${text}</p>
        <label><input type="checkbox" class="pause"> Pause</label>
      </figcaption>
    </figure>`,
  );
  return `<!DOCTYPE html>
<html lang="en">
  <head>
    <meta charset="utf-8">
    <meta name="viewport" content="width=device-width, initial-scale=1">
    <title>Scenes that move</title>
    <link rel="stylesheet" href="motion.css">
    <script type="module" src="${first.folder}/runtime/imgeo.js"></script>
    <script type="module" src="motion.js"></script>
  </head>
  <body>
    <h1>Scenes that move</h1>
${figures.join("\n")}
  </body>
</html>
`;
}
