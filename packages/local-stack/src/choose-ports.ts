/** Ports for programs that people know by their usual numbers: those, or the next that are free. */

export interface WantedPort {
  /** What listens there, for people. */
  name: string;
  port: number;
  /** This one and no other. */
  fixed?: boolean;
}

export interface ChosenPorts {
  /** In the order of what was wanted. */
  ports: number[];
  /** Wanted ports that others have. */
  moved: { wanted: WantedPort; port: number }[];
}

/** A port was wanted, that and no other, and somebody has it. */
export class PortTaken extends Error {
  override readonly name = 'PortTaken';
  readonly wanted: WantedPort;

  constructor(wanted: WantedPort) {
    super(`port ${wanted.port} is taken`);
    this.wanted = wanted;
  }
}

const MOST_PORT = 65_535;

/** @throws {PortTaken} */
export async function choosePorts(
  wanted: readonly WantedPort[],
  isFree: (port: number) => Promise<boolean>,
): Promise<ChosenPorts> {
  // What others of ours want by its number stays theirs.
  const spoken = new Set(wanted.map(({ port }) => port));
  const chosen: ChosenPorts = { ports: [], moved: [] };
  for (const want of wanted) {
    let { port } = want;
    if (!(await isFree(port))) {
      do port++;
      while (!want.fixed && port <= MOST_PORT && (spoken.has(port) || !(await isFree(port))));
      if (want.fixed || port > MOST_PORT) throw new PortTaken(want);
      spoken.add(port);
      chosen.moved.push({ wanted: want, port });
    }
    chosen.ports.push(port);
  }
  return chosen;
}
