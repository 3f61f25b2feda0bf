// Runs in a page before its scripts and adds up the bytes of live WebGL2 buffers and textures.

export interface GpuCount {
  gpuBytes: number;
}

/** Self-contained: its text is sent to the browser. Counts level 0 of textures, which the measured pages use alone. */
export function countGpuBytes(): void {
  const count = window as unknown as GpuCount;
  count.gpuBytes = 0;
  type Call = (this: WebGL2RenderingContext, ...args: never[]) => unknown;
  const gl = WebGL2RenderingContext.prototype as unknown as Record<string, Call>;
  const sizes = new WeakMap<object, number>();
  const setSize = (object: object | null, bytes: number): void => {
    if (object === null) return;
    count.gpuBytes += bytes - (sizes.get(object) ?? 0);
    sizes.set(object, bytes);
  };
  const wrap = (name: string, note: (context: WebGL2RenderingContext, args: readonly unknown[]) => void): void => {
    const original = gl[name]!;
    gl[name] = function (this: WebGL2RenderingContext, ...args: never[]) {
      note(this, args);
      return original.apply(this, args);
    };
  };

  const bufferBindings: Record<number, number> = {
    0x8892: 0x8894, // ARRAY_BUFFER
    0x8893: 0x8895, // ELEMENT_ARRAY_BUFFER
    0x8a11: 0x8a28, // UNIFORM_BUFFER
    0x88eb: 0x88ed, // PIXEL_PACK_BUFFER
    0x88ec: 0x88ef, // PIXEL_UNPACK_BUFFER
    0x8f36: 0x8f36, // COPY_READ_BUFFER
    0x8f37: 0x8f37, // COPY_WRITE_BUFFER
  };
  wrap("bufferData", (context, [target, source]) => {
    const bytes = typeof source === "number" ? source : ((source as ArrayBufferView | null)?.byteLength ?? 0);
    const binding = bufferBindings[target as number];
    if (binding !== undefined) setSize(context.getParameter(binding) as object | null, bytes);
  });
  wrap("deleteBuffer", (_, [buffer]) => {
    setSize(buffer as object | null, 0);
  });

  /** Bytes of a texel of an internal format, from its name: RGBA16F has four times 16 bits. */
  const texelBytes = (format: number, context: WebGL2RenderingContext): number => {
    const constants = context as unknown as Record<string, unknown>;
    for (const name in context) {
      const parts = /^(R|RG|RGB|RGBA|SRGB|SRGB8_ALPHA)(8|16|32)(F|I|UI)?(_SNORM)?$/.exec(name);
      if (parts !== null && constants[name] === format)
        return ({ R: 1, RG: 2, RGB: 3, SRGB: 3 }[parts[1]!] ?? 4) * (Number(parts[2]) / 8);
    }
    return 4; // depth, and formats that pack several channels
  };
  const boundTexture = (context: WebGL2RenderingContext, target: number): object | null => {
    const binding =
      target === context.TEXTURE_2D
        ? context.TEXTURE_BINDING_2D
        : target === context.TEXTURE_3D
          ? context.TEXTURE_BINDING_3D
          : target === context.TEXTURE_2D_ARRAY
            ? context.TEXTURE_BINDING_2D_ARRAY
            : context.TEXTURE_BINDING_CUBE_MAP;
    return context.getParameter(binding) as object | null;
  };
  wrap("texStorage2D", (context, [target, , format, width, height]) => {
    const faces = target === context.TEXTURE_CUBE_MAP ? 6 : 1;
    const texels = (width as number) * (height as number) * faces;
    setSize(boundTexture(context, target as number), texels * texelBytes(format as number, context));
  });
  wrap("texStorage3D", (context, [target, , format, width, height, depth]) => {
    const texels = (width as number) * (height as number) * (depth as number);
    setSize(boundTexture(context, target as number), texels * texelBytes(format as number, context));
  });
  wrap("texImage2D", (context, args) => {
    const [target, level, format] = args as number[];
    if (level !== 0) return;
    const source = args[5] as { width?: number; height?: number } | number;
    const [width, height] =
      typeof source === "object" && args.length < 9
        ? [source.width ?? 0, source.height ?? 0]
        : [args[3] as number, args[4] as number];
    setSize(boundTexture(context, target!), width * height * texelBytes(format!, context));
  });
  wrap("deleteTexture", (_, [texture]) => {
    setSize(texture as object | null, 0);
  });
}
