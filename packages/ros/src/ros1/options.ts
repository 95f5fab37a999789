export interface Ros1Options {
  /** The master, for example `http://localhost:11311`. */
  masterUrl: string;
  /** The node’s name, with or without a leading slash. */
  name: string;
  /** How others reach this machine: a name or an address that they know. */
  hostname: string;
}
