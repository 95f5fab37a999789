/**
 * Draws the view as it is seen, into a canvas of its own: the cloud, the cameras and the small maps in their places, and a caption.
 * The cloud's canvas keeps nothing after a frame has been shown, so this is called in the frame that has just been drawn.
 */
import { contained, type PictureSize, type PlacedBox } from '../../ground/capture/picture-size.ts';
import { elements } from '../ui/elements.ts';

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** Height of a line of the caption, as a share of the picture's height, and at least, pixels. Chosen: it is read on a phone. */
const LINE_SHARE = 1 / 36;
const LEAST_LINE_PX = 12;
/** Of a line's height: its letters, and the room around all lines. */
const FONT_SHARE = 0.75;
const PADDING = 0.5;
/** Colours of the caption: over any picture, in any theme. */
const CAPTION_GROUND = 'rgb(0 0 0 / 65%)';
const CAPTION_TEXT = 'white';

/** The size of what is seen, in pixels of the screen. */
export function viewSize(): PictureSize {
  const { innerWidth, innerHeight, devicePixelRatio } = window;
  return { width: innerWidth * devicePixelRatio, height: innerHeight * devicePixelRatio };
}

/** @param size of what is drawn into */
export function paintView(context: Context, size: PictureSize, caption: readonly string[]): void {
  const view = { width: window.innerWidth, height: window.innerHeight };
  const { width, height } = size;
  const place = contained({ left: 0, top: 0, width, height }, view);
  const scale = place.width / Math.max(view.width, 1);
  context.fillStyle = 'black';
  context.fillRect(0, 0, width, height);
  for (const canvas of shownCanvases()) {
    const box = shownBox(canvas);
    const { left, top } = box;
    const [x, y] = [place.left + left * scale, place.top + top * scale];
    context.drawImage(canvas, x, y, box.width * scale, box.height * scale);
    const name = labelOf(canvas);
    if (name !== '') paintText(context, [name], { left: x, top: y, px: linePx(size) });
  }
  const px = linePx(size);
  paintText(context, caption, { left: 0, top: height - (caption.length + PADDING) * px, px });
}

/** What is drawn on the screen: what fills it first, then what lies over it. */
function shownCanvases(): HTMLCanvasElement[] {
  const { world, pictures, minimapPicture, nearRing } = elements;
  const all = [...world.querySelectorAll('canvas'), ...pictures.querySelectorAll('canvas')];
  return [...all, minimapPicture, nearRing].filter(
    (canvas) => canvas.width > 0 && canvas.height > 0 && canvas.checkVisibility({ visibilityProperty: true }),
  );
}

function shownBox(canvas: HTMLCanvasElement): PlacedBox {
  const box = canvas.getBoundingClientRect();
  return getComputedStyle(canvas).objectFit === 'contain' ? contained(box, canvas) : box;
}

/** Which camera it is and how old its picture: a frozen one must not look live. Empty for what is no camera's. */
function labelOf(canvas: HTMLCanvasElement): string {
  const panel = canvas.closest('figure');
  const staged = canvas.closest('#camera-stage')?.querySelector('p');
  const parts = [panel?.querySelector('.name'), panel?.querySelector('.age'), staged];
  return parts
    .map((part) => part?.textContent?.trim() ?? '')
    .filter((text) => text !== '')
    .join(' · ');
}

function linePx({ height }: PictureSize): number {
  return Math.max(LEAST_LINE_PX, Math.round(height * LINE_SHARE));
}

/** @param px height of a line */
function paintText(
  context: Context,
  lines: readonly string[],
  { left, top, px }: { left: number; top: number; px: number },
): void {
  context.font = `${Math.round(px * FONT_SHARE)}px sans-serif`;
  context.textBaseline = 'middle';
  const width = Math.max(0, ...lines.map((line) => context.measureText(line).width));
  context.fillStyle = CAPTION_GROUND;
  context.fillRect(left, top, width + px, (lines.length + PADDING) * px);
  context.fillStyle = CAPTION_TEXT;
  for (const [i, line] of lines.entries())
    context.fillText(line, left + px / 2, top + (i + 0.5 + PADDING / 2) * px);
}
