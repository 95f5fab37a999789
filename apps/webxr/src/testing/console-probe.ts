/** What an operator reads in the headset: labels on the controllers, notices before the eyes, and the menu. */
import type { Vector3 } from 'three';
import type { App } from '../app.ts';

export interface ConsoleProbe {
  /** The labels that are in view. */
  labels: { hand: 'left' | 'right'; control: string; text: string }[];
  /** `null` while nothing is said. Degrees: height of capital letters, the upper edge above the line of sight, width. */
  notice: { rows: string[]; letterDegrees: number; topDegrees: number; widthDegrees: number } | null;
  /** `null` while it is closed. */
  menu: {
    title: string;
    items: { text: string; canChoose: boolean }[];
    marked: number;
    /** Middle of each row in the operator's room, metres: right, up, back. */
    places: [number, number, number][];
  } | null;
  /** Middles of STOP and of the menu on the wrist, in the operator's room; `null` while they are not there. */
  tab: { stop: [number, number, number]; menu: [number, number, number] } | null;
}

export function consoleProbe({ headset, stage }: App): ConsoleProbe | null {
  if (headset === null) return null;
  const { menu, labels, sign } = headset.console;
  const page = menu.page.value;
  const inRoom = (places: Vector3[]) =>
    places.map((place) => stage.rig.worldToLocal(place).toArray() as [number, number, number]);
  const [stop, tabMenu] = inRoom(headset.console.tabPlaces());
  return {
    labels: labels.flatMap(({ hand, shown }) => shown.map((label) => ({ hand, ...label }))),
    notice: sign.shown,
    menu:
      page === null
        ? null
        : {
            title: page.title,
            items: page.items.map(({ text, choice }) => ({ text, canChoose: choice !== null })),
            marked: menu.marked.value,
            places: inRoom(headset.console.rowPlaces()),
          },
    tab: stop === undefined || tabMenu === undefined ? null : { stop, menu: tabMenu },
  };
}

export function wristProbe({ headset }: App): { text: string; tone: string }[] | null {
  return headset?.panel.shown?.map(({ text, tone }) => ({ text, tone })) ?? null;
}
