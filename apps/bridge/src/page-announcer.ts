/**
 * What pages are told about robots. The reference system's page looks a switched robot up in the last list that it
 * was sent, and fails if the robot is missing. A list that names the robot is therefore always sent first. Pure.
 */
import type { ReferenceBridgeToPage } from '@farpoint/protocol';

export interface ShownRobots {
  readonly robots: readonly { id: number; name: string }[];
  /** The robot that is shown. */
  readonly selected: number | null;
}

export class PageAnnouncer {
  /** The list that every page has, as text. Pages assume an empty list before the first. */
  #list: string = listText([]);
  #selected: number | null = null;

  /** What is new to pages that were up to date, in the order in which it must be sent. */
  changes(now: ShownRobots): ReferenceBridgeToPage[] {
    const list = listText(now.robots);
    const messages: ReferenceBridgeToPage[] = list === this.#list ? [] : [listMessage(now)];
    const selected = shownRobot(now);
    if (selected !== null && selected !== this.#selected) messages.push(switchMessage(selected));
    this.#list = list;
    this.#selected = selected;
    return messages;
  }

  /** Everything, for a page that has been told nothing. */
  present(now: ShownRobots): ReferenceBridgeToPage[] {
    const selected = shownRobot(now);
    return selected === null ? [listMessage(now)] : [listMessage(now), switchMessage(selected)];
  }
}

function listText(robots: ShownRobots['robots']): string {
  return JSON.stringify(robots.map(({ id, name }) => [id, name]));
}

/** The protocol has no message for "no robot is shown any longer". */
function shownRobot({ robots, selected }: ShownRobots): number | null {
  return robots.some(({ id }) => id === selected) ? selected : null;
}

export function listMessage({ robots }: ShownRobots): ReferenceBridgeToPage {
  return { type: 'updateRobots', robots: robots.length === 0 ? null : [...robots] };
}

function switchMessage(robotId: number): ReferenceBridgeToPage {
  return { type: 'switchedRobot', robotId };
}
