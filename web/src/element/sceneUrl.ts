// The scene of a converted site, from whatever names the site.

/**
 * The URL of the X3D document for the `src` of an <imgeo-viewer>: a site's folder ("statue/", "statue"), its page
 * ("statue/index.html") or an X3D document, which is returned as it is. A query is kept. Empty for an empty `src`.
 */
export function sceneUrlOf(src: string): string {
  const [, path = "", query = ""] = /^([^?#]*)(\?[^#]*)?/.exec(src.trim()) ?? [];
  if (path === "" && query === "") return "";
  if (/\.x3d$/i.test(path)) return path + query;
  const isPage = /\.x?html?$/i.test(path);
  const folder = isPage
    ? path.slice(0, path.lastIndexOf("/") + 1)
    : path === "" || path.endsWith("/")
      ? path
      : `${path}/`;
  return `${folder}scene.x3d${query}`;
}
