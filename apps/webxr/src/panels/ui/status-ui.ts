/** Shows the link, who drives, and the session's figures. */
import { effect } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { aboutWords, withoutWheelsWords } from '../../words/about-words.ts';
import { alarmLine } from '../../words/alarm-words.ts';
import type { Banner } from '../../words/banner-words.ts';
import { sessionFacts } from '../../words/facts.ts';
import type { ShownReading } from '../../words/shown-readings.ts';
import type { Words } from '../../words/words.ts';
import { elements } from './elements.ts';
import { showFacts } from './facts-table.ts';

export function showStatus({ link, driving, robot, figures }: PageState): void {
  effect(() => setPill(elements.link, link.line.value));
  effect(() => showBanner(link.banner.value));
  effect(() => {
    const connected = link.connected.value;
    elements.robots.hidden = connected;
    elements.disconnect.hidden = !connected;
    elements.view.hidden = !connected;
  });
  effect(() => {
    const line = alarmLine(robot.alarms.value);
    elements.alarm.hidden = line === null;
    if (line === null) return;
    setText(elements.alarm, line.text);
    elements.alarm.dataset.tone = line.tone;
  });
  effect(() => {
    const live = link.live.value;
    elements.drive.hidden = !live;
    elements.hud.hidden = !live;
    // Whatever stands there was true a moment ago.
    elements.hud.dataset.stale = String(!link.heard.value);
  });
  effect(() => {
    const words = aboutWords(robot.about.value);
    elements.about.hidden = words.length === 0;
    elements.about.replaceChildren(...words.map(pillOf));
  });
  effect(() => {
    const drives = robot.drives.value;
    setPill(elements.holder, drives ? driving.line.value : withoutWheelsWords());
    // Neither can be asked of a robot that does not hear.
    elements.take.disabled = !link.heard.value;
    elements.release.disabled = !link.heard.value;
    elements.take.hidden = !drives || !driving.mayTake.value;
    elements.release.hidden = driving.holder.value !== 'you';
    const watches = !drives || driving.role.value === 'watch';
    elements.joystick.hidden = watches;
    elements.driveHint.hidden = watches;
  });
  effect(() => showWords(elements.motionState, robot.motion.value));
  effect(() => showWords(elements.obstacleGuard, robot.obstacleGuard.value));
  showFigures({ link, robot, figures });
}

function showFigures({ link, robot, figures }: Pick<PageState, 'link' | 'robot' | 'figures'>): void {
  effect(() => {
    if (!link.live.value) return;
    const { name, telemetry, estop, readings, componentTopics } = robot;
    // That all components are well takes no room.
    const isWell = ({ topic, tone }: ShownReading) =>
      tone === 'neutral' && componentTopics.value.includes(topic);
    showFacts(
      sessionFacts({
        heard: link.heard.value,
        pointsHeard: robot.pointsHeard.value,
        drives: robot.drives.value,
        name: name.value,
        telemetry: telemetry.value,
        estop: estop.value,
        maxLinear: robot.maxLinear.value,
        readings: readings.value.filter((reading) => !isWell(reading)),
        figures: figures.value,
      }),
    );
  });
}

function showBanner(banner: Banner | null): void {
  const { banner: element, bannerTitle, bannerText } = elements;
  element.role = banner?.urgent === false ? 'status' : 'alert';
  element.hidden = banner === null;
  setText(bannerTitle, banner?.title ?? '');
  setText(bannerText, banner?.text ?? '');
}

function showWords(element: HTMLElement, words: Words | null): void {
  element.hidden = words === null;
  if (words !== null) setPill(element, words);
}

function pillOf(words: Words): HTMLElement {
  const pill = document.createElement('span');
  pill.className = 'pill';
  setPill(pill, words);
  return pill;
}

function setPill(element: HTMLElement, words: Words): void {
  setText(element, words.text);
  element.dataset.tone = words.tone;
}

function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
