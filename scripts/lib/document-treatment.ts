/** How a command in the documents is tested. */

/** Why a command cannot run where tests run. */
export type Obstacle =
  | 'needs root'
  | 'needs systemd'
  | 'needs a container engine'
  | 'needs a ROS installation'
  | 'needs a robot that is installed'
  | 'builds for minutes'
  | 'measures for minutes'
  | 'runs until it is ended, and every test of it'
  | 'writes into the working tree'
  | 'needs Rust';

export type Treatment =
  /** Runs as written until it logs this. `also` keeps it off other programs' ports and services. */
  | { up: string | RegExp; also?: readonly string[]; fill?: Readonly<Record<string, string>> }
  /** Runs as written and cannot start here, for this reason. */
  | { refused: RegExp; also?: readonly string[] }
  /** Its program's help must name each of its options. */
  | { help: true; because?: Obstacle }
  /** This file must name each of its options. */
  | { options: string; because: Obstacle }
  /** Only its files and its script must exist. */
  | { because: Obstacle };
