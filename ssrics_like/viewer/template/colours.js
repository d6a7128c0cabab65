// Colours are the page's own, light or dark; a canvas must be told.
const COLOURS = ["ground", "free", "wall", "seen", "past", "ahead", "left", "front", "right", "beam", "hit", "arc", "halo", "curve", "band", "limit", "grid", "ink", "muted", "rule", "surface", "robot"];
let colours = {};
const readColours = () => {
  const style = getComputedStyle(document.documentElement);
  colours = Object.fromEntries(COLOURS.map(name => [name, style.getPropertyValue(`--${name}`).trim()]));
};
const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, Helvetica, Arial, sans-serif';
const sectorColour = sector => ({ left: colours.left, front: colours.front, right: colours.right })[sector] || colours.muted;

// A canvas as large as its box, in pixels of the screen; true if its size changed.
const fit = canvas => {
  const ratio = window.devicePixelRatio || 1;
  const box = canvas.getBoundingClientRect();
  const width = Math.max(1, Math.round(box.width * ratio)), height = Math.max(1, Math.round(box.height * ratio));
  if (canvas.width === width && canvas.height === height) return false;
  canvas.width = width;
  canvas.height = height;
  return true;
};
// The context of a canvas, empty, in pixels of the page.
const cleared = canvas => {
  const context = canvas.getContext("2d");
  const ratio = window.devicePixelRatio || 1;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
};
// A picture of grey levels as one of colours: `colour(level)` gives "rgb" parts and opacity.
const coloured = (image, colour) => {
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < pixels.data.length; i += 4) pixels.data.set(colour(pixels.data[i]), i);
  context.putImageData(pixels, 0, 0);
  return canvas;
};
const partsOf = hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16));
