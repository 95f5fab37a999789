/**
 * Below the cameras' panels: whether the videos are in step, and on a click what the compositor did with each, and how the
 * link is divided.
 */
import { effect, signal } from '@preact/signals-core';
import { PRIORITIES, PRIORITY_WORDS } from '../../state/link-priority.ts';
import type { PageState } from '../../state/page-state.ts';
import { videoReport } from '../../words/video-report.ts';
import { quietButton, rowOf, selectOf } from './panel-parts.ts';

export function videoReportPanel({ figures, videos, priority }: PageState): HTMLElement {
  const open = signal(false);
  const panel = document.createElement('section');
  panel.className = 'video-report';
  const button = quietButton('', 'What became of the videos’ frames', () => {
    open.value = !open.peek();
  });
  const list = document.createElement('dl');
  const share = shareControl(priority);
  panel.append(button, share, list);
  effect(() => {
    // Where the strip has no room for it, it is scrolled to.
    if (open.value) requestAnimationFrame(() => panel.scrollIntoView({ block: 'nearest' }));
  });
  effect(() => {
    const names = videos.views.value.map(({ camera }) => camera.name);
    panel.hidden = names.length === 0;
    if (names.length === 0) return;
    const { summary, tone, lines } = videoReport(figures.value.videos, names);
    if (button.textContent !== summary) button.textContent = summary;
    button.dataset.tone = tone;
    button.ariaExpanded = String(open.value);
    list.hidden = !open.value;
    share.hidden = !open.value;
    if (open.value)
      list.replaceChildren(
        ...lines.flatMap(({ name, text, tone }) => [textOf('dt', name), textOf('dd', text, tone)]),
      );
  });
  return panel;
}

/** What comes first where the link does not carry everything. */
function shareControl({ chosen }: PageState['priority']): HTMLElement {
  const words = PRIORITIES.map((priority) => PRIORITY_WORDS[priority]);
  const select = selectOf('What comes first on a slow link', words, (word) => {
    chosen.value = PRIORITIES[words.indexOf(word)] ?? 'balanced';
  });
  select.selectedIndex = PRIORITIES.indexOf(chosen.peek());
  const row = rowOf('Slow link', select);
  row.classList.add('link-share', 'overlay');
  return row;
}

function textOf(tag: 'dt' | 'dd', text: string, tone = ''): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = text;
  element.dataset.tone = tone;
  return element;
}
