/** Why a robot description cannot be used. */
export const urdfFaultCodes = [
  'too-large', // longer than a description may be
  'not-xml', // not well-formed
  'doctype', // its document type defines something, such as entities
  'not-urdf', // its root is not <robot>
  'xacro', // it has macros that nobody has expanded
  'bad-value', // a number, a name or a type that URDF does not have
  'unknown-name', // a link, or a joint that another mimics, does not exist
  'not-a-tree', // two links have none or the same parent, or joints form a ring
  'too-many', // more elements, links, moving links or shapes than are read
] as const;
export type UrdfFaultCode = (typeof urdfFaultCodes)[number];

/** Characters; names can be as long as the description. */
const MOST_DETAIL = 300;

/** A robot description cannot be used; the message says what is wrong, and where. */
export class UrdfFault extends Error {
  override readonly name = 'UrdfFault';
  readonly code: UrdfFaultCode;

  /** @param line in the description, from 1; 0: nowhere in particular */
  constructor(code: UrdfFaultCode, detail: string, line = 0) {
    const words = detail.length > MOST_DETAIL ? `${detail.slice(0, MOST_DETAIL)}…` : detail;
    super(line === 0 ? words : `line ${line}: ${words}`);
    this.code = code;
  }
}
