/** The navigator's path and map, for people: each with its age, and whether it is too old to be drawn. */
import type { AgedReading, RobotSession } from '@farpoint/operator';
import { type MapView, mapView, type PathView, pathView } from '../ground/navigation/navigation-view.ts';
import { texts } from './language.ts';
import { type ShownReading, shownReading } from './shown-readings.ts';
import type { Words } from './words.ts';

/** The robot's readings; those of its navigator say how old what is drawn is. @param nowMs page's clock */
export function readingsWithNavigation(
  { readings, plannedPath, map }: Pick<RobotSession, 'readings' | 'plannedPath' | 'map'>,
  nowMs: number,
): ShownReading[] {
  return readings.list(nowMs).map((aged) => {
    const shown = shownReading(aged);
    if (aged.reading.level !== 'ok') return shown;
    const text = textOf(aged);
    const words =
      aged.reading.topic === plannedPath.topic
        ? pathWords(text, pathView(plannedPath, nowMs))
        : aged.reading.topic === map.topic
          ? mapWords(text, mapView(map, nowMs))
          : null;
    return words === null ? shown : { ...shown, ...words };
  });
}

/** @param text what the robot says of it */
function pathWords(text: string, view: PathView | null): Words | null {
  if (view === null) return null;
  if (!view.stale) return { text, tone: 'neutral' };
  return { text: texts().motion.oldNotDrawn(text, durationWords(view.ageMs)), tone: 'warning' };
}

/** @param text what the robot says of it */
function mapWords(text: string, view: MapView | null): Words | null {
  if (view === null) return null;
  const said = texts().motion;
  if (!view.stale) return { text: said.aged(text, durationWords(view.ageMs)), tone: 'neutral' };
  return { text: said.silentNotDrawn(text, durationWords(view.silentMs)), tone: 'warning' };
}

function textOf({ reading: { values } }: AgedReading): string {
  return values.map(([, value]) => value).join(' · ');
}

function durationWords(ms: number): string {
  const seconds = Math.round(ms / 1000);
  if (seconds < 120) return `${seconds} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}
