/**
 * How far down the left column reaches: to what the hands use, and no further. Nothing in it may lie over the row for
 * driving, whatever it has to say. What does not fit scrolls: open controls first, down to two rows, then the figures
 * and opened notes (`flex-shrink` in style.css).
 */
import { roomAbove } from '../../ground/panels/room-above.ts';
import { elements } from './elements.ts';

/** Keeps the left column above the row for driving, and `controls`, a list in it, too. */
export function boundLeftColumn(controls: HTMLElement): void {
  const { hud, drive, facts, noGpu, people, clouds } = elements;
  const giving = [facts, noGpu, people];
  const parts = [...drive.children];
  const update = () => {
    const below = parts
      .map((part) => part.getBoundingClientRect())
      .filter(({ width, height }) => width > 0 && height > 0);
    const roomOf = (box: Element, higher: number) => {
      const { left, right, top } = box.getBoundingClientRect();
      return roomAbove({ left, right, top: top + higher }, below, window.innerHeight);
    };
    hud.style.maxHeight = `${roomOf(hud, 0)}px`;
    const given = giving.map((part) => Math.max(0, part.scrollHeight - part.clientHeight));
    // A box over the picture takes the mouse only while there is something in it to be scrolled to.
    for (const [i, part] of giving.entries()) part.classList.toggle('cut', (given[i] ?? 0) > 1);
    if (controls.hidden) return;
    // Controls are measured from where they would begin, had nothing above them given way.
    const inColumn = getComputedStyle(clouds).position !== 'fixed';
    const higher = inColumn ? given.reduce((sum, height) => sum + height, 0) : 0;
    controls.style.maxHeight = `${roomOf(controls, higher)}px`;
  };
  const observer = new ResizeObserver(update);
  // Whatever is above the controls moves them, and the column grows with it.
  for (const watched of [controls, hud, drive, ...giving, ...parts]) observer.observe(watched);
  window.addEventListener('resize', update);
}
