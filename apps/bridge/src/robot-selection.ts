/** Decides which of the robots streams: at most one. Pure; the caller carries the decisions out. */

export interface SelectionEvents {
  /** `start` for the robot that is shown, `stop` for every other. */
  onSwitch: (robotId: number, word: 'start' | 'stop') => void;
  /** The shown robot has changed; `null` if none is shown. */
  onSelected: (robotId: number | null) => void;
}

/**
 * The first robot to appear is shown until another one is chosen. If the chosen robot leaves and comes back with the
 * same name, it is shown again. The protocol then gives it another id.
 */
export class RobotSelection {
  selected: number | null = null;
  readonly #events: SelectionEvents;
  readonly #names = new Map<number, string>();
  /** Name of the robot that was chosen or appeared first. */
  #wanted: string | null = null;

  constructor(events: SelectionEvents) {
    this.#events = events;
  }

  get robots(): { id: number; name: string }[] {
    return [...this.#names].map(([id, name]) => ({ id, name }));
  }

  add(id: number, name: string): void {
    this.#names.set(id, name);
    if (this.selected === null && (this.#wanted === null || this.#wanted === name)) this.select(id);
  }

  remove(id: number): void {
    this.#names.delete(id);
    if (this.selected !== id) return;
    this.selected = null;
    // Its new connection may already be here.
    const same = this.robots.find(({ name }) => name === this.#wanted);
    if (same === undefined) this.#events.onSelected(null);
    else this.select(same.id);
  }

  /** Changes a robot's id, which makes the old id free. */
  rekey(from: number, to: number): void {
    const name = this.#names.get(from);
    if (name === undefined) return;
    this.#names.delete(from);
    this.#names.set(to, name);
    if (this.selected !== from) return;
    this.selected = to;
    this.#events.onSelected(to);
  }

  /** @returns false if there is no such robot; nothing changes then */
  select(id: number): boolean {
    const name = this.#names.get(id);
    if (name === undefined) return false;
    this.#wanted = name;
    if (this.selected === id) return true;
    const before = this.selected;
    this.selected = id;
    if (before !== null) this.#events.onSwitch(before, 'stop');
    this.#events.onSwitch(id, 'start');
    this.#events.onSelected(id);
    return true;
  }

  /** What to tell a robot whose channel has just opened. */
  wordFor(id: number): 'start' | 'stop' {
    return id === this.selected ? 'start' : 'stop';
  }
}
