/** Sessions in a few words. Pure. */
import type { SessionReport } from '../ground/report/report-schema.ts';
import { laterTexts } from './language.ts';

/** How long something took, for people: `1:02:03` hours or `2:03` minutes. @param seconds 0 or more */
export function durationText(seconds: number): string {
  const whole = Math.round(seconds);
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  const two = (number: number) => String(number).padStart(2, '0');
  const end = two(whole % 60);
  return hours > 0 ? `${hours}:${two(minutes)}:${end}` : `${minutes}:${end}`;
}

/** Which robot, when, and for how long. */
export function sessionText({ robot, beganMs, durationS, end }: SessionReport): string {
  const { sessionOf, lasts } = laterTexts().report;
  const time = new Date(beganMs).toLocaleTimeString([], { timeStyle: 'short' });
  return sessionOf(robot.name, time, end === null ? lasts : durationText(durationS));
}
