// A page that an author writes around the files of a recorded sequence: X3D's own TimeSensor, CoordinateInterpolator and
// ROUTE play it, and a slider sets the sensor's fraction.

/** The first part of a document that matches. */
function partOf(document: string, pattern: RegExp): string {
  const [part] = pattern.exec(document) ?? [];
  if (part === undefined) throw new Error(`the site has no ${pattern.source}: it is not one of a sequence`);
  return part;
}

const attributeOf = (element: string, name: string): string =>
  partOf(element, new RegExp(`(?<=\\s${name}=")[^"]*`, "i"));

/**
 * The page, for the folder of the site. `document`: the site's page or scene.x3d, of which it takes the geometry, that
 * is the names of the files, and the duration; everything else is written here.
 */
export function sequencePage(document: string, title: string): string {
  const geometry = partOf(document, /<ImageGeometry[\s\S]*?<\/ImageGeometry>/i);
  const frames = attributeOf(partOf(geometry, /<CoordinateInterpolator[^>]*>/i), "DEF");
  const seconds = attributeOf(partOf(document, /<TimeSensor[^>]*>/i), "cycleInterval");
  return `<!DOCTYPE html>
<html lang="en">
  <head>
    <meta charset="utf-8">
    <meta name="viewport" content="width=device-width, initial-scale=1">
    <title>${title}</title>
    <link rel="stylesheet" href="scrub.css">
    <script type="module" src="runtime/imgeo.js"></script>
    <script type="module" src="scrub.js"></script>
  </head>
  <body>
    <h1>${title}</h1>
    <X3D alt="${title}">
      <Scene>
        <Background skyColor="0.93 0.94 0.95"></Background>
        <TimeSensor DEF="clock" cycleInterval="${seconds}" loop="true"></TimeSensor>
        <Shape>
          <Appearance><Material diffuseColor="0.72 0.25 0.2"></Material></Appearance>
          ${geometry}
        </Shape>
        <ROUTE fromNode="clock" fromField="fraction_changed" toNode="${frames}" toField="set_fraction"></ROUTE>
      </Scene>
    </X3D>
    <p class="controls">
      <button type="button" class="play">Stop</button>
      <input type="range" class="scrub" min="0" max="1" step="0.001" value="0" aria-label="Time">
      <button type="button" class="second">Show second 1</button>
    </p>
  </body>
</html>
`;
}
