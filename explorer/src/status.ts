/** How a motion along a path of the drives ended, as the kernel says it. */

export const enum Status {
  DONE,
  LIMIT,
  SINGULAR,
  START,
  GIVEN_UP,
}
