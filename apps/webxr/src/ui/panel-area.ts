/** The part of the screen that panels may be in: between the bar and what the hands use, so that neither is covered. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { Box } from '../panels/panel-layout.ts';
import { elements } from './elements.ts';

const MARGIN = 8;
/** On a narrower screen panels stay in their strip: there is no room to move them to, rem. As in the style sheet. */
const NARROW_REM = 40;

/** @returns `null` while panels cannot be moved; follows the window's size */
export function panelArea(): ReadonlySignal<Box | null> {
  const area = signal<Box | null>(null);
  const update = () => {
    const next = isNarrow() ? null : measure();
    if (JSON.stringify(next) !== JSON.stringify(area.peek())) area.value = next;
  };
  const observer = new ResizeObserver(update);
  observer.observe(elements.bar);
  observer.observe(elements.stopBand);
  observer.observe(elements.drive);
  window.addEventListener('resize', update);
  update();
  return area;
}

function isNarrow(): boolean {
  const rem = Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
  return window.innerWidth <= NARROW_REM * rem;
}

function measure(): Box {
  const { bar, stopBand } = elements;
  const top = bar.getBoundingClientRect().bottom + stopBand.offsetHeight + MARGIN;
  const { height, top: driveTop } = elements.drive.getBoundingClientRect();
  const bottom = (height === 0 ? window.innerHeight : driveTop) - MARGIN;
  return {
    ...{ left: MARGIN, top, width: Math.max(0, window.innerWidth - 2 * MARGIN) },
    height: Math.max(0, bottom - top),
  };
}
