/** The part of the screen that panels may be in: between the bar and what the hands use, so that neither is covered. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { Box } from '../../ground/panels/panel-layout.ts';
import { elements } from './elements.ts';

const MARGIN = 8;
/** On a smaller screen panels stay in their strip: there is no room to move them to, pixels. As in the style sheet. */
const NARROW = '(max-width: 640px)';

/** @returns `null` while panels cannot be moved; follows the window's size */
export function panelArea(): ReadonlySignal<Box | null> {
  const area = signal<Box | null>(null);
  const update = () => {
    const next = window.matchMedia(NARROW).matches ? null : measure();
    if (JSON.stringify(next) !== JSON.stringify(area.peek())) area.value = next;
  };
  const observer = new ResizeObserver(update);
  observer.observe(elements.bar);
  observer.observe(elements.drive);
  window.addEventListener('resize', update);
  update();
  return area;
}

function measure(): Box {
  const top = elements.bar.getBoundingClientRect().bottom + MARGIN;
  const { height, top: driveTop } = elements.drive.getBoundingClientRect();
  const bottom = (height === 0 ? window.innerHeight : driveTop) - MARGIN;
  return {
    left: MARGIN,
    top,
    width: Math.max(0, window.innerWidth - 2 * MARGIN),
    height: Math.max(0, bottom - top),
  };
}
