"""The audit of tables made by others: which model and variant a table holds, in which layout, and what is wrong with it."""

from albedo_lab.lookup.audit.asking import audit
from albedo_lab.lookup.audit.defects import Defect
from albedo_lab.lookup.audit.record import Audit

__all__ = ["Audit", "Defect", "audit"]
