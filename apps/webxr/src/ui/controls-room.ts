/** How high a list of controls in the left column may be: down to what the hands use, whatever is above it. */
import { roomAbove } from '../panels/room-above.ts';
import { elements } from './elements.ts';

/** Keeps `controls` above the row for driving. They scroll if they have more rows. */
export function keepInRoom(controls: HTMLElement): void {
  const parts = [...elements.drive.children];
  const update = () => {
    if (controls.hidden) return;
    const below = parts
      .map((part) => part.getBoundingClientRect())
      .filter(({ width, height }) => width > 0 && height > 0);
    controls.style.maxHeight = `${roomAbove(controls.getBoundingClientRect(), below, window.innerHeight)}px`;
  };
  const observer = new ResizeObserver(update);
  // Whatever is above the controls moves them, and the column grows with it.
  for (const watched of [controls, elements.hud, elements.drive, ...parts]) observer.observe(watched);
  window.addEventListener('resize', update);
}
