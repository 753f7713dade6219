"""How commands end."""

import contextlib
import io
import unittest

from tamp import failure


class Guard(unittest.TestCase):
    def test_a_standard_output_that_cannot_be_reconfigured_is_taken_as_it_is(self):
        """As ParaView's Python has it."""
        with contextlib.redirect_stdout(io.StringIO()) as out, self.assertRaises(SystemExit) as ended:
            failure.guard(lambda: print("drawn"))

        self.assertEqual((out.getvalue(), ended.exception.code), ("drawn\n", None))
