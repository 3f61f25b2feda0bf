// Colours between two colours, in HSV space as X3D's ColorInterpolator has it (ISO/IEC 19775-1, 19.4.1).

/** Hue 0 … 6, saturation and value 0 … 1. */
function hsvOf(red: number, green: number, blue: number): [hue: number, saturation: number, value: number] {
  const value = Math.max(red, green, blue);
  const chroma = value - Math.min(red, green, blue);
  if (chroma === 0) return [0, 0, value];
  const hue =
    value === red ? (green - blue) / chroma : value === green ? 2 + (blue - red) / chroma : 4 + (red - green) / chroma;
  return [(hue + 6) % 6, chroma / value, value];
}

function rgbOf(hue: number, saturation: number, value: number): [number, number, number] {
  const channel = (offset: number): number => {
    const at = (offset + hue) % 6;
    return value - value * saturation * Math.max(0, Math.min(at, 4 - at, 1));
  };
  return [channel(5), channel(3), channel(1)];
}

/** The hue goes the shorter way around. A grey has no hue of its own and takes the other colour's. */
export function mixedColor(a: readonly number[], b: readonly number[], t: number): [number, number, number] {
  const [hueA, saturationA, valueA] = hsvOf(a[0] ?? 0, a[1] ?? 0, a[2] ?? 0);
  const [hueB, saturationB, valueB] = hsvOf(b[0] ?? 0, b[1] ?? 0, b[2] ?? 0);
  const from = saturationA === 0 ? hueB : hueA;
  const to = saturationB === 0 ? from : hueB;
  let turn = to - from;
  if (turn > 3) turn -= 6;
  else if (turn < -3) turn += 6;
  const mix = (x: number, y: number): number => x + (y - x) * t;
  return rgbOf((from + turn * t + 6) % 6, mix(saturationA, saturationB), mix(valueA, valueB));
}
